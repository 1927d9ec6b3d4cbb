#include "solver/design/shaped_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace misalign::solver {
namespace {

// Where all is folded flat the equations are singular, and angles known to the root of the closure
// tolerance: 6e-5 degrees.
constexpr double kShownOverFold_deg = 1e-3;

Eigen::Matrix3Xd laid_over(const Eigen::Matrix3Xd& shape_mm, const FlatVertices& flat_mm) {
  Eigen::Matrix3Xd place_mm = Eigen::Matrix3Xd::Zero(3, flat_mm.cols());
  place_mm.topRows<2>() = flat_mm;
  const Eigen::Isometry3d moved(Eigen::umeyama(shape_mm, place_mm, false));
  return moved * shape_mm;
}

// The first such pair of vertices: a rectangle has two, and rounding must not choose between them.
std::pair<int, int> farthest_apart(const FlatVertices& vertices_mm) {
  constexpr double kLongerBy = 1 + 1e-9;  // far above what a sheet loses that is drawn far off
  std::pair<int, int> span{0, 0};
  double longest = 0;
  for (int a = 0; a < static_cast<int>(vertices_mm.cols()); ++a) {
    for (int b = a + 1; b < static_cast<int>(vertices_mm.cols()); ++b) {
      const double length = (vertices_mm.col(a) - vertices_mm.col(b)).norm();
      if (length > kLongerBy * longest) longest = length, span = {a, b};
    }
  }
  return span;
}

}  // namespace

Eigen::Index ShapedPath::rows_up_to_d() const {
  Eigen::Index rows = 0;
  for (std::size_t row = 0; row < history.stations.size(); ++row) {
    const int sample = history.stations[row].sample;
    if (sample > 0 && sample <= history.verdict.deploys_from_sample) {
      rows = static_cast<Eigen::Index>(row) + 1;
    }
  }
  return rows;
}

Eigen::Index rows_shown(const Mechanism& mechanism, const ShapedPath& path) {
  const Eigen::Index up_to_d = path.rows_up_to_d();
  return up_to_d > 0 ? up_to_d : rows_folded_well(mechanism, path.history, kShownOverFold_deg);
}

std::vector<Eigen::Index> rows_to_show(const Mechanism& mechanism, const ShapedPath& path,
                                       double step_deg) {
  std::vector<Eigen::Index> rows;
  const Eigen::Index end = rows_shown(mechanism, path);
  for (Eigen::Index row = 0; row < end; ++row) {
    const double away =
        std::remainder(path.history.stations[static_cast<std::size_t>(row)].pilot_deg, step_deg);
    if (std::abs(away) < 1e-9 || row + 1 == end) rows.push_back(row);
  }
  return rows;
}

ShapedPath record_shapes(const Model& model, const FlatVertices& vertices_mm) {
  SheetGeometry<double> geometry;
  place(model.mechanism(), vertices_mm, geometry);
  const auto [from, to] = farthest_apart(vertices_mm);
  const double per_deg = model.mechanism().panel_width_mm * kRadPerDeg;
  FoldedPoints<double> points;
  std::vector<Twist<double>> twists;
  ShapedPath path;
  const StationVisitor keep_shape = [&, from = from, to = to](const Station&,
                                                              const PathPoint& point) {
    model.shape().place(geometry, point.state, points);
    model.shape().move(geometry, points, point.rates.data(), twists);
    path.span_slope_mm_per_deg.push_back(per_deg *
                                         model.shape().distance_rate(points, twists, from, to));
    path.shapes_mm.push_back(
        laid_over(model.shape().vertices_mm(geometry, point.state), vertices_mm));
  };
  path.history = record_history(model, vertices_mm, &keep_shape);
  path.shapes_mm.resize(path.history.stations.size());
  path.span_slope_mm_per_deg.resize(path.history.stations.size());
  return path;
}

}  // namespace misalign::solver
