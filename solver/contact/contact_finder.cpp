#include "solver/contact/contact_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kNever = std::numeric_limits<double>::infinity();

// The neighbours of a corner, seen from it.
std::array<Vector3d, 2> arms_of(const PolygonCorners& corners, int at) {
  assert(corners.cols() == 4 && at >= 0 && at < 4);
  return {corners.col((at + 3) % 4) - corners.col(at), corners.col((at + 1) % 4) - corners.col(at)};
}

// The sector of a panel at a corner, out to `radius_mm` at least: a triangle.
PolygonCorners sector_of(const PolygonCorners& corners, int at, double radius_mm) {
  assert(radius_mm > 0);
  const auto [before, after] = arms_of(corners, at);
  const Vector3d to_after = after.normalized(), to_before = before.normalized();
  const double cos_half = (to_after + to_before).norm() / 2;
  assert(cos_half > 0 && "corners of a panel are convex");
  const double side_mm = 1.01 * radius_mm / cos_half;
  PolygonCorners sector(3, 3);
  sector << corners.col(at), corners.col(at) + side_mm * to_after,
      corners.col(at) + side_mm * to_before;
  return sector;
}

// Angle between a unit vector and the sector between two others.
double angle_from_sector(const Vector3d& ray, const Vector3d& first_side,
                         const Vector3d& second_side) {
  assert(std::abs(ray.norm() - 1) < 1e-6);
  const Vector3d normal = first_side.cross(second_side).normalized();
  const double height = normal.dot(ray);
  const Vector3d foot = ray - height * normal;
  if (normal.dot(first_side.cross(foot)) >= 0 && normal.dot(foot.cross(second_side)) >= 0) {
    return std::asin(std::min(1.0, std::abs(height)));
  }
  const auto between = [&](const Vector3d& edge) {
    return std::atan2(ray.cross(edge).norm(), ray.dot(edge));
  };
  return std::min(between(first_side), between(second_side));
}

// The clearance of two panels with a common crease: 180 degrees less its |fold angle|, times the
// panel width.
class CreaseWalk : public GapWalk {
 public:
  CreaseWalk(const PanelMotion& motion, int crease) : GapWalk(motion), crease_(crease) {}

  double move_to(double x) override {
    x_ = x;
    const double angle_rad = motion_.crease_rad(x, crease_);
    direction_ = angle_rad > 0 ? -Vector3d::UnitZ() : Vector3d(Vector3d::UnitZ());
    gaps_mm_.resize(1);
    gaps_mm_(0) = (kPi - std::abs(angle_rad)) * motion_.panel_width_mm();
    return gaps_mm_(0);
  }

 protected:
  void find_rates(int node, PolygonCorners& rates) const override {
    rates.setZero(3, 1);
    rates(2, 0) =
        motion_.crease_rate(node < 0 ? -1 - node : node, crease_) * motion_.panel_width_mm();
  }

 private:
  const int crease_;
};

double bounding_radius(const PolygonCorners& corners, const Vector3d& centre) {
  return std::sqrt((corners.colwise() - centre).colwise().squaredNorm().maxCoeff());
}

}  // namespace

ContactFinder::ContactFinder(const Panels& panels, const PanelMotion& motion, double touch_mm)
    : panels_(panels), motion_(motion), touch_mm_(touch_mm), pairs_(pairs_of(panels)) {}

std::unique_ptr<GapWalk> ContactFinder::walk_of(const PanelPair& pair) const {
  if (pair.kind == ContactKind::crease) return std::make_unique<CreaseWalk>(motion_, pair.joint);
  const PolygonCorners &a = motion_.corners_mm(pair.a), &b = motion_.corners_mm(pair.b);
  if (pair.kind == ContactKind::apart) {
    return std::make_unique<PolygonWalk>(motion_, pair.a, pair.b, a, b);
  }
  // Two sectors with one apex meet where the one's chord, b's diagonal, meets the other.
  const int at_a = corner_of(panels_.corners[pair.a], pair.joint);
  const int at_b = corner_of(panels_.corners[pair.b], pair.joint);
  assert(at_a < 4 && at_b < 4 && "both panels have the vertex");
  const auto [before, after] = arms_of(b, at_b);
  PolygonCorners chord(3, 2);
  chord << b.col((at_b + 3) % 4), b.col((at_b + 1) % 4);
  const double radius_mm = std::max(before.norm(), after.norm());
  return std::make_unique<PolygonWalk>(motion_, pair.a, pair.b, sector_of(a, at_a, radius_mm),
                                       chord);
}

std::optional<Contact> ContactFinder::first(double end) const {
  assert(end >= 0);
  std::optional<Contact> first;
  for (const PanelPair& pair : pairs_) {
    const std::unique_ptr<GapWalk> walk = walk_of(pair);
    const double x = first_touch(*walk, touch_mm_, first ? first->x : end);
    if (x == kNever || (first && x >= first->x)) continue;
    const auto* polygons = dynamic_cast<const PolygonWalk*>(walk.get());
    first = contact_of(pair, polygons ? polygons->separation() : Separation{}, x);
  }
  assert(!first || (first->x >= 0 && first->x <= end));
  return first;
}

Contact ContactFinder::contact_of(const PanelPair& pair, const Separation& where, double x) const {
  const FoldingWay& way = motion_.way();
  Contact contact{pair, x, way.pilot_deg(x), {}, {}};
  if (pair.kind == ContactKind::crease) {
    const FoldLine& fold = panels_.folds[static_cast<std::size_t>(pair.joint)];
    contact.on_a_mm =
        way.drawn_mm((way.from_a1_mm().col(fold.a) + way.from_a1_mm().col(fold.b)) / 2);
    contact.on_b_mm = contact.on_a_mm;
    return contact;
  }
  // Points are seen from panel a; those of b are transformed by the poses of both.
  const PanelMotion::Pose a = motion_.pose(x, pair.a), b = motion_.pose(x, pair.b);
  const Vector3d on_b = seen_from(b, a, where.on_b);
  contact.on_a_mm = way.drawn_mm(where.on_a.head<2>());
  contact.on_b_mm = way.drawn_mm(on_b.head<2>());
  return contact;
}

double ContactFinder::vertex_angle_rad(const PanelPair& pair, double x) const {
  const PanelMotion::Pose a = motion_.pose(x, pair.a), b = motion_.pose(x, pair.b);
  const auto rays = [&](int panel, const PanelMotion::Pose& pose) {
    std::array<Vector3d, 2> arms =
        arms_of(motion_.corners_mm(panel), corner_of(panels_.corners[panel], pair.joint));
    for (Vector3d& arm : arms) arm = pose.rotation * arm.normalized();
    return arms;
  };
  const auto [a_before, a_after] = rays(pair.a, a);
  const auto [b_before, b_after] = rays(pair.b, b);
  return std::min({angle_from_sector(a_before, b_after, b_before),
                   angle_from_sector(a_after, b_after, b_before),
                   angle_from_sector(b_before, a_after, a_before),
                   angle_from_sector(b_after, a_after, a_before)});
}

ContactFinder::Clearance ContactFinder::clearance(double x) const {
  std::vector<PolygonCorners> corners_mm;
  std::vector<Vector3d> centres_mm;
  std::vector<double> radii_mm;
  for (int panel = 0; panel < motion_.panels(); ++panel) {
    const PanelMotion::Pose pose = motion_.pose(x, panel);
    corners_mm.push_back((pose.rotation * motion_.corners_mm(panel)).colwise() + pose.shift_mm);
    centres_mm.push_back(corners_mm.back().rowwise().mean());
    radii_mm.push_back(bounding_radius(corners_mm.back(), centres_mm.back()));
  }
  Clearance least{kNever, 180, 180, -1};
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const PanelPair& pair = pairs_[k];
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (pair.kind == ContactKind::vertex) {
      least.vertex_deg = std::min(least.vertex_deg, vertex_angle_rad(pair, x) / kRadPerDeg);
    }
    if (pair.kind != ContactKind::apart) continue;
    const double between_mm = (centres_mm[a] - centres_mm[b]).norm() - radii_mm[a] - radii_mm[b];
    if (between_mm >= least.apart_mm) continue;
    const double apart_mm = separation_of(corners_mm[a], corners_mm[b]).distance;
    if (apart_mm >= least.apart_mm) continue;
    least.apart_mm = apart_mm;
    least.apart = static_cast<int>(k);
  }
  for (std::size_t crease = 0; crease < panels_.folds.size(); ++crease) {
    const double angle_rad = std::abs(motion_.crease_rad(x, static_cast<int>(crease)));
    least.crease_deg = std::min(least.crease_deg, 180 - angle_rad / kRadPerDeg);
  }
  return least;
}

}  // namespace misalign::solver
