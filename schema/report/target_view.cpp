#include "schema/report/target_view.hpp"

#include <algorithm>

#include "schema/files/base64.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

// Points along either side of the grid, and its size over the sheet's.
constexpr Index kAcross = 17;
constexpr double kWider = 1.08;
// Steps to a height of the surface, and its least slope against the vertical.
constexpr int kSteps = 40;
constexpr double kLeastUp = 0.2;

// The surface's point over a place.
Vector3d point_over(const solver::TargetSurface& surface, double x, double y) {
  Vector3d at(x, y, 0);
  for (int step = 0; step < kSteps; ++step) {
    const solver::SurfaceDistance away = surface.distance(at);
    at.z() -= away.mm / std::max(away.normal.z(), kLeastUp);
  }
  return at;
}

}  // namespace

Json target_shown_json(const solver::Sheet& sheet, const solver::ShapeMeasure& measure) {
  const auto row = sheet.row_at(measure.at_deg());
  if (!row || !measure.target().surface) return nullptr;
  const Eigen::Matrix3Xd& shape_mm = sheet.shapes_mm()[static_cast<std::size_t>(*row)];
  const solver::ShapePose pose = measure.pose(shape_mm);
  const solver::ShapeMisfit off = misfit(measure.target(), shape_mm, pose);
  const Eigen::Matrix3Xd placed_mm = pose.placed(shape_mm);
  const Eigen::Vector2d least = placed_mm.topRows<2>().rowwise().minCoeff(),
                        most = placed_mm.topRows<2>().rowwise().maxCoeff(),
                        middle = (least + most) / 2, half = kWider / 2 * (most - least);
  const Eigen::Matrix2Xd& flat_mm = sheet.vertices_mm();
  Vector3d centre_mm = Vector3d::Zero();
  centre_mm.head<2>() = (flat_mm.rowwise().minCoeff() + flat_mm.rowwise().maxCoeff()) / 2;
  std::vector<float> points;
  for (Index i = 0; i < kAcross * kAcross; ++i) {
    const auto share = [](Index k) { return 2.0 * static_cast<double>(k) / (kAcross - 1) - 1; };
    const Vector3d on =
        point_over(*measure.target().surface, middle.x() + share(i % kAcross) * half.x(),
                   middle.y() + share(i / kAcross) * half.y());
    const Vector3d seen = pose.turn.transpose() * (on - pose.move_mm) - centre_mm;
    for (const double mm : seen) points.push_back(static_cast<float>(mm));
  }
  // A panel has the largest distance of what is measured on it.
  const Eigen::VectorXd distances_mm = off.distances_mm();
  Json panels = Json::array();
  for (const auto& corners : sheet.panels().corners) {
    double largest_mm = 0;
    for (Index k = 0; k < distances_mm.size(); ++k) {
      const bool is_on =
          std::ranges::any_of(corners, [&](int v) { return measure.target().weights(k, v) != 0; });
      if (is_on) largest_mm = std::max(largest_mm, distances_mm(k));
    }
    panels.push_back(largest_mm);
  }
  return {{"pilot_deg", measure.at_deg()}, {"columns", kAcross},     {"points_mm", base64(points)},
          {"panels_mm", panels},           {"rms_mm", off.rms_mm()}, {"max_mm", off.max_mm()}};
}

}  // namespace misalign::schema
