#include "solver/kinematics/filler.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "solver/kinematics/shape_check.hpp"
#include "solver/pattern/disjoint_sets.hpp"
#include "solver/pattern/half_angle.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

// A corner within this of its flat angle is no wider: lengths are known to about 1e-13 of a panel.
constexpr double kAsWide_rad = 1e-11;

Vector3d flat_point(const FlatVertices& vertices_mm, int v) {
  return {vertices_mm(0, v), vertices_mm(1, v), 0};
}

double angle_between(const Vector3d& u, const Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

double flat_width_rad(const Filler& filler, const FlatVertices& vertices_mm) {
  const Vector3d corner = flat_point(vertices_mm, filler.corner);
  return angle_between(flat_point(vertices_mm, filler.before) - corner,
                       flat_point(vertices_mm, filler.after) - corner);
}

double width_rad(const Filler& filler, const Eigen::Matrix3Xd& shape_mm) {
  const Vector3d corner = shape_mm.col(filler.corner);
  return angle_between(shape_mm.col(filler.before) - corner, shape_mm.col(filler.after) - corner);
}

// Rank of a filler over all shapes; smaller is better.
struct Rating {
  bool changes_sides = false;
  double largest_deg = 0;
  bool operator<(const Rating& other) const {
    return std::tie(changes_sides, largest_deg) < std::tie(other.changes_sides, other.largest_deg);
  }
};

Rating rate(const Filler& filler, const PerforatedSheet& base, const FlatVertices& vertices_mm,
            const std::vector<const Eigen::Matrix3Xd*>& shapes_mm) {
  Rating rating;
  std::array<double, 3> last{};
  for (const Eigen::Matrix3Xd* shape_mm : shapes_mm) {
    const Filler::Folded folded = folded_filler(filler, base, vertices_mm, *shape_mm);
    for (std::size_t k = 0; k < last.size(); ++k) {
      const double angle = folded.angle_deg[k];
      rating.largest_deg = std::max(rating.largest_deg, std::abs(angle));
      if (last[k] * angle < 0) rating.changes_sides = true;
      last[k] = angle;
    }
  }
  return rating;
}

struct Choice {
  Filler filler;
  Rating rating;
};

// Every corner of a hole, in both ways, that can follow all shapes; the best come first.
std::vector<Choice> choices(const PerforatedSheet& base, const Mechanism& mechanism,
                            const FlatVertices& vertices_mm,
                            const std::vector<const Eigen::Matrix3Xd*>& shapes_mm) {
  std::vector<Choice> all;
  for (const BallJoint& ball : mechanism.balls) {
    for (const int hole : base.holes) {
      std::optional<Filler> filler = filler_at(base, hole, ball.vertex);
      if (!filler) continue;
      const double most_rad = flat_width_rad(*filler, vertices_mm) + kAsWide_rad;
      const bool follows =
          std::all_of(shapes_mm.begin(), shapes_mm.end(), [&](const Eigen::Matrix3Xd* shape_mm) {
            return width_rad(*filler, *shape_mm) <= most_rad;
          });
      for (const int way : {1, -1}) {
        filler->way = way;
        if (follows) all.push_back({*filler, rate(*filler, base, vertices_mm, shapes_mm)});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Choice& a, const Choice& b) { return a.rating < b.rating; });
  return all;
}

// Returns whether two fillers disturb each other: in one hole only opposite corners can both have
// one.
bool disturb(const Filler& filler, const Filler& other) {
  return filler.hole == other.hole &&
         (filler.corner == other.corner || filler.corner == other.before ||
          filler.corner == other.after);
}

}  // namespace

std::optional<Filler> filler_at(const PerforatedSheet& base, int hole, int corner) {
  const std::array<int, 4>& corners = base.sheet.facets[hole];
  const auto at = std::find(corners.begin(), corners.end(), corner);
  if (at == corners.end()) return std::nullopt;
  const auto k = static_cast<std::size_t>(at - corners.begin());
  Filler filler{hole, corner, corners[(k + 3) % 4], corners[(k + 1) % 4], -1, -1};
  const auto beyond = [&](int vertex) {
    const Edge& edge = base.sheet.edges[find_edge(base.sheet, corner, vertex)];
    return edge.left == hole ? edge.right : edge.left;
  };
  filler.from = beyond(filler.before);
  filler.to = beyond(filler.after);
  const std::vector<int> around = facets_around(base.sheet, corner);
  const auto is_hole = [&](int f) {
    return std::binary_search(base.holes.begin(), base.holes.end(), f);
  };
  // Two of the four facets are holes, never side by side: the vertex is a ball joint.
  if (std::count_if(around.begin(), around.end(), is_hole) != 2) return std::nullopt;
  return filler;
}

Eigen::Vector2d flat_apex_mm(const Filler& filler, const FlatVertices& vertices_mm) {
  const Eigen::Vector2d corner = vertices_mm.col(filler.corner);
  const Eigen::Vector2d before = vertices_mm.col(filler.before) - corner,
                        after = vertices_mm.col(filler.after) - corner;
  // The bisector divides the opposite side in the ratio of the adjacent sides.
  const double share = before.norm() / (before.norm() + after.norm());
  return corner + (before + share * (after - before)) / 2;
}

Filler::Folded folded_filler(const Filler& filler, const PerforatedSheet& base,
                             const FlatVertices& vertices_mm, const Eigen::Matrix3Xd& shape_mm) {
  const Vector3d corner = shape_mm.col(filler.corner);
  const Vector3d before = (shape_mm.col(filler.before) - corner).normalized(),
                 after = (shape_mm.col(filler.after) - corner).normalized();
  const double flat_rad = flat_width_rad(filler, vertices_mm) / 2,
               half_rad = width_rad(filler, shape_mm) / 2;
  // Napier's rule for the two right triangles that the bisector makes of before, apex and after:
  // cos(flat) = cos(half) cos(rise).
  const double rise_sine =
      std::sqrt(std::max(0.0, std::sin(flat_rad - half_rad) * std::sin(flat_rad + half_rad))) /
      std::cos(half_rad);
  const double rise_cosine = std::cos(flat_rad) / std::cos(half_rad);
  const Vector3d middle = (before + after).normalized(), above = after.cross(before).normalized();
  const double reach_mm =
      (flat_apex_mm(filler, vertices_mm) - vertices_mm.col(filler.corner)).norm();
  const Vector3d ray = rise_cosine * middle + filler.way * rise_sine * above;
  Filler::Folded folded{corner + reach_mm * ray, {}};
  const Vector3d first = ray.cross(before).normalized(), second = after.cross(ray).normalized();
  const auto panel_normal = [&](int f) { return normal_of(shape_mm, base.sheet.facets[f]); };
  // The hole is on the left on the way into the corner and out of it; the first triangle is on the
  // left on the way to the apex.
  folded.angle_deg = {fold_angle_deg(-before, first, panel_normal(filler.from)),
                      fold_angle_deg(ray, first, second),
                      fold_angle_deg(after, second, panel_normal(filler.to))};
  return folded;
}

std::optional<std::vector<Filler>> joining_fillers(
    const PerforatedSheet& base, const Mechanism& mechanism, const FlatVertices& vertices_mm,
    const std::vector<const Eigen::Matrix3Xd*>& shapes_mm) {
  DisjointSets panels(base.sheet.facets.size());
  std::size_t apart = kept_facets(base.sheet, base.holes).size() - 1;
  for (const Crease& crease : mechanism.creases) apart -= panels.tie(crease.left, crease.right);
  std::vector<Filler> fillers;
  for (const Choice& choice : choices(base, mechanism, vertices_mm, shapes_mm)) {
    const Filler& filler = choice.filler;
    const bool has_room = std::none_of(fillers.begin(), fillers.end(),
                                       [&](const Filler& other) { return disturb(filler, other); });
    if (!has_room || !panels.tie(filler.from, filler.to)) continue;
    fillers.push_back(filler);
    --apart;
  }
  if (apart > 0) return std::nullopt;
  return fillers;
}

}  // namespace misalign::solver
