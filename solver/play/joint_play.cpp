#include "solver/play/joint_play.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

// The corner of a panel at a ball joint: its neighbours on the panel's sides.
struct JointCorner {
  int vertex, next, before;

  Vector3d bisector(const Eigen::Matrix3Xd& at_mm) const {
    return (direction(next, at_mm) + direction(before, at_mm)).normalized();
  }
  // A direction of the flat panel where it is folded to.
  Vector3d turned(const Vector3d& flat, const Eigen::Matrix3Xd& flat_mm,
                  const Eigen::Matrix3Xd& at_mm) const {
    Eigen::Matrix<double, 3, 2> from, to;
    from << direction(next, flat_mm), direction(before, flat_mm);
    to << direction(next, at_mm), direction(before, at_mm);
    return to * from.colPivHouseholderQr().solve(flat);
  }
  // The distance of a bore from the vertex.
  double bore_mm(const Eigen::Matrix3Xd& flat_mm, const JointParts& parts) const {
    const double sine = 0.5 * (direction(next, flat_mm) - direction(before, flat_mm)).norm();
    const double apart_mm = 0.5 * parts.bore_mm + parts.edge_mm;
    return std::max(apart_mm / sine, parts.trim_mm > 0 ? parts.trim_mm + apart_mm : 0);
  }

 private:
  Vector3d direction(int to, const Eigen::Matrix3Xd& at_mm) const {
    return (at_mm.col(to) - at_mm.col(vertex)).normalized();
  }
};

JointCorner corner_at(const Sheet& sheet, int facet, int vertex) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  const auto k = static_cast<std::size_t>(std::ranges::find(around, vertex) - around.begin());
  return {vertex, around[(k + 1) % 4], around[(k + 3) % 4]};
}

// The play of one joint over states, of which the first is flat.
double play_mm(const Sheet& sheet, const BallJoint& ball, const JointParts& parts,
               const std::vector<const Eigen::Matrix3Xd*>& states) {
  const JointCorner from = corner_at(sheet, ball.from_facet, ball.vertex),
                    to = corner_at(sheet, ball.to_facet, ball.vertex);
  const Eigen::Matrix3Xd& flat_mm = *states.front();
  const Vector3d strip = (from.bisector(flat_mm) - to.bisector(flat_mm)).normalized();
  double least_mm = INFINITY, most_mm = 0, bent_rad = 0;
  for (const Eigen::Matrix3Xd* state : states) {
    const double apart_mm = (from.bore_mm(flat_mm, parts) * from.bisector(*state) -
                             to.bore_mm(flat_mm, parts) * to.bisector(*state))
                                .norm();
    const Vector3d begin = from.turned(strip, flat_mm, *state),
                   end = to.turned(strip, flat_mm, *state);
    least_mm = std::min(least_mm, apart_mm);
    most_mm = std::max(most_mm, apart_mm);
    bent_rad = std::max(bent_rad, std::atan2(begin.cross(end).norm(), begin.dot(end)));
  }
  if (parts.kind == JointKind::loop) return most_mm - least_mm + parts.bore_mm - parts.wire_mm;
  constexpr double kFlat_rad = 1e-6;  // rounding; the play there is 1e-13 of the length
  if (bent_rad < kFlat_rad) return 0;
  return parts.strip_mm * (std::tan(bent_rad / 2) / bent_rad - 0.5);
}

}  // namespace

JointPlay joint_play(const Sheet& sheet, const JointParts& parts, Eigen::Index rows) {
  assert(parts.wire_mm <= parts.bore_mm);
  if (sheet.mechanism().balls.empty()) return {};
  if (parts.kind == JointKind::ball) return {0.5 * parts.clearance_mm, -1};
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, sheet.vertices_mm().cols());
  flat_mm.topRows<2>() = sheet.vertices_mm();
  std::vector<const Eigen::Matrix3Xd*> states = {&flat_mm};
  for (Eigen::Index row = 0; row < rows; ++row) {
    states.push_back(&sheet.shapes_mm()[static_cast<std::size_t>(row)]);
  }
  JointPlay worst;
  for (std::size_t k = 0; k < sheet.mechanism().balls.size(); ++k) {
    const double play = play_mm(sheet, sheet.mechanism().balls[k], parts, states);
    if (play > worst.play_mm) worst = {play, static_cast<int>(k)};
  }
  return worst;
}

}  // namespace misalign::solver
