#include "schema/print/ball_joints.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/files/user_error.hpp"
#include "schema/kit/chords.hpp"
#include "schema/kit/panel_corner.hpp"
#include "schema/print/lathe.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::schema {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using solver::OptionFault;

// Largest length of necks and stems within their plates, where bores leave room.
constexpr double kWithin_mm = 2;

// A panel's axes as columns: along its first side, and its normal last.
Matrix3d axes_of(const std::array<int, 4>& around, const Matrix3Xd& at_mm) {
  const Vector3d along = (at_mm.col(around[1]) - at_mm.col(around[0])).normalized(),
                 normal = (at_mm.col(around[2]) - at_mm.col(around[0]))
                              .cross(at_mm.col(around[3]) - at_mm.col(around[1]))
                              .normalized();
  Matrix3d axes;
  axes << along, normal.cross(along), normal;
  return axes;
}

Vector3d spatial(const Vector2d& flat) { return {flat.x(), flat.y(), 0}; }

// A cone of directions: its axis and half angle.
struct Cone {
  Vector3d axis;
  double half_rad;
};

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The smallest cone round directions (Badoiu & Clarkson 2003).
Cone cone_round(const std::vector<Vector3d>& directions) {
  constexpr int kSteps = 1000;
  const auto farthest = [&](const Vector3d& axis) {
    return *std::ranges::min_element(
        directions, {}, [&](const Vector3d& direction) { return direction.dot(axis); });
  };
  Vector3d axis = directions.front();
  for (int k = 2; k < kSteps; ++k) axis = (axis + (farthest(axis) - axis) / k).normalized();
  return {axis, angle_between(axis, farthest(axis))};
}

// Points of a circle round the origin by their angle from the negative axis.
PlanePoints arc(double radius_mm, double from_rad, double to_rad) {
  return arc_points({0, 0}, radius_mm, from_rad - std::numbers::pi / 2, to_rad - from_rad);
}

void append(PlanePoints& profile, const PlanePoints& more) {
  profile.insert(profile.end(), more.begin(), more.end());
}

void append(Solid& plate, const Solid& shell) {
  const int first = static_cast<int>(plate.vertices_mm.size());
  plate.vertices_mm.insert(plate.vertices_mm.end(), shell.vertices_mm.begin(),
                           shell.vertices_mm.end());
  for (const auto& [a, b, c] : shell.triangles) {
    plate.triangles.push_back({first + a, first + b, first + c});
  }
}

class JointMaker {
 public:
  JointMaker(const solver::Sheet& sheet, const KitOptions& options)
      : sheet_(sheet),
        sizes_(options),
        trim_mm_(options.plates->trim_mm),
        last_mm_(trim_mm_ + std::min(kWithin_mm, options.bore_edge_mm)),
        rows_(solver::rows_of_use(sheet, options.from_deg)) {
    flat_mm_ = Matrix3Xd::Zero(3, sheet.vertices_mm().cols());
    flat_mm_.topRows<2>() = sheet.vertices_mm();
    if (options.joints->clearance_mm < kLeastBallClearance_mm) {
      throw UserError(
          OptionFault{"joints.clearance_mm", fmt::format("{:g}", options.joints->clearance_mm),
                      "too little for balls and sockets that are printed in one another",
                      fmt::format("take {:g} mm or more", kLeastBallClearance_mm)});
    }
    if (trim_mm_ >= sizes_.outer_mm) return;
    throw UserError(
        OptionFault{"trim_mm", fmt::format("{:g}", trim_mm_),
                    fmt::format("less than the radius of sockets, {:.3g} mm", sizes_.outer_mm),
                    "trim more, or take smaller balls by " + parameter("ball_mm")});
  }

  Solid ball(const solver::BallJoint& joint) const {
    PlanePoints profile = arc(sizes_.ball_mm, 0, std::numbers::pi - neck_rad(sizes_.ball_mm));
    profile.front().x() = 0;
    append(profile, {{sizes_.neck_mm, last_mm_}, {0, last_mm_}});
    return lathe(profile, at(joint), bisector(joint.from_facet, joint.vertex));
  }

  Solid socket(const solver::BallJoint& joint) const {
    const Cone mouth = mouth_of(joint);
    const double rim_rad = std::numbers::pi - mouth.half_rad;
    PlanePoints profile = arc(sizes_.outer_mm, 0, rim_rad);
    append(profile, arc(sizes_.socket_mm, rim_rad, 0));
    profile.front().x() = profile.back().x() = 0;
    return lathe(profile, at(joint), mouth.axis);
  }

  // It reaches from within the socket's wall into the plate.
  Solid stem(const solver::BallJoint& joint) const {
    const double first_mm = sizes_.socket_mm + 0.25 * (sizes_.outer_mm - sizes_.socket_mm);
    return lathe(
        {{0, first_mm}, {sizes_.neck_mm, first_mm}, {sizes_.neck_mm, last_mm_}, {0, last_mm_}},
        at(joint), bisector(joint.to_facet, joint.vertex));
  }

 private:
  // Half the angle at which the neck is seen from the vertex, at a distance.
  double neck_rad(double distance_mm) const { return std::asin(sizes_.neck_mm / distance_mm); }

  Vector3d at(const solver::BallJoint& joint) const { return flat_mm_.col(joint.vertex); }

  Vector3d bisector(int facet, int vertex) const {
    return spatial(PanelCorner(sheet_, facet, vertex).bisector);
  }

  // The turn of a panel in a state.
  Matrix3d turn(int facet, const Matrix3Xd& at_mm) const {
    const auto& around = sheet_.base().sheet.facets[static_cast<std::size_t>(facet)];
    return axes_of(around, at_mm) * axes_of(around, flat_mm_).transpose();
  }

  // The opening of a socket, in its flat plate.
  Cone mouth_of(const solver::BallJoint& joint) const {
    const Vector3d neck = bisector(joint.from_facet, joint.vertex);
    std::vector<Vector3d> directions = {neck};
    for (Eigen::Index row = 0; row < rows_; ++row) {
      const Matrix3Xd& at_mm = sheet_.shapes_mm()[static_cast<std::size_t>(row)];
      directions.emplace_back(turn(joint.to_facet, at_mm).transpose() *
                              (turn(joint.from_facet, at_mm) * neck));
    }
    Cone mouth = cone_round(directions);
    const double swing_rad = mouth.half_rad, clear_mm = sizes_.socket_mm - sizes_.ball_mm;
    mouth.half_rad += std::asin((sizes_.neck_mm + clear_mm) / sizes_.socket_mm);
    const double stem_rad = angle_between(mouth.axis, bisector(joint.to_facet, joint.vertex));
    const bool is_held = mouth.half_rad < std::numbers::pi / 2 &&
                         sizes_.socket_mm * std::sin(mouth.half_rad) < kMostRim * sizes_.ball_mm &&
                         stem_rad > mouth.half_rad + neck_rad(sizes_.socket_mm);
    if (is_held) return mouth;
    throw UserError(OptionFault{
        "joints.kind", "ball",
        fmt::format("not held by its socket at {}, where it swings by ±{:.0f} deg",
                    solver::vertex_label(joint.vertex), swing_rad / solver::kRadPerDeg),
        "take loops, a smaller angle of use, or less " + parameter("joints.clearance_mm")});
  }

  const solver::Sheet& sheet_;
  const BallSizes sizes_;
  const double trim_mm_, last_mm_;  // distances from the vertex: of plates, and of ends within them
  const Eigen::Index rows_;
  Matrix3Xd flat_mm_;
};

}  // namespace

BallSizes::BallSizes(const KitOptions& options)
    : ball_mm(0.5 * options.ball_mm.value_or(options.plates->thickness_mm)),
      socket_mm(ball_mm + 0.5 * options.joints->clearance_mm),
      outer_mm(socket_mm + std::max(kSocketWall_mm, kSocketWallPart * ball_mm)),
      neck_mm(std::min(kNeckPart * ball_mm, 0.5 * options.plates->thickness_mm)) {}

void add_ball_joints(const solver::Sheet& sheet, const KitOptions& options,
                     std::vector<Solid>& plates) {
  const JointMaker maker(sheet, options);
  const std::vector<int>& facets = sheet.panels().facets;
  const auto plate_of = [&](int facet) -> Solid& {
    return plates[static_cast<std::size_t>(std::ranges::find(facets, facet) - facets.begin())];
  };
  for (const solver::BallJoint& joint : sheet.mechanism().balls) {
    append(plate_of(joint.from_facet), maker.ball(joint));
    append(plate_of(joint.to_facet), maker.socket(joint));
    append(plate_of(joint.to_facet), maker.stem(joint));
  }
}

}  // namespace misalign::schema
