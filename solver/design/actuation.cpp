#include "solver/design/actuation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/verdict/metrics.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

std::pair<Index, Index> farthest_apart(const FlatVertices& vertices_mm) {
  std::pair<Index, Index> span{0, 0};
  double longest = -1;
  for (Index a = 0; a < vertices_mm.cols(); ++a) {
    for (Index b = a + 1; b < vertices_mm.cols(); ++b) {
      const double length = (vertices_mm.col(a) - vertices_mm.col(b)).norm();
      if (length > longest) longest = length, span = {a, b};
    }
  }
  return span;
}

// Rows of the actuation that are samples from 5 degrees to D.
std::vector<Index> judged_rows(const FoldingHistory& history) {
  std::vector<Index> rows;
  for (std::size_t i = 0; i < history.stations.size(); ++i) {
    const Station& station = history.stations[i];
    if (station.sample > 0 && station.sample <= history.verdict.deploys_from_sample &&
        station.pilot_deg >= kSlopeFrom_deg) {
      rows.push_back(static_cast<Index>(i) + 1);
    }
  }
  return rows;
}

void find_weakest(const FoldingHistory& history, Actuation& actuation) {
  const std::vector<Index> rows = judged_rows(history);
  for (const Index row : rows) {
    const double moment = actuation.moment_n_mm[row];
    if (!actuation.weakest || std::abs(moment) < std::abs(actuation.weakest->moment_n_mm)) {
      actuation.weakest = {actuation.pilot_deg[row], moment};
    }
  }
  if (rows.empty()) return;
  const Eigen::MatrixXd moments = actuation.moment_by_n_mm(rows, Eigen::all);
  if (moments.rowwise().sum().minCoeff() > 0) actuation.few = few_diagonals(moments, kShareOfFew);
}

void find_over_stroke(const FoldingHistory& history, Actuation& actuation) {
  const std::optional<double> limit = actuation.actuators.stroke_limit;
  if (!limit) return;
  for (Index row = 0; row < history.length_mm.rows(); ++row) {
    const int sample = history.stations[row].sample;
    if (sample == 0 || sample > history.verdict.deploys_from_sample) continue;
    for (Index d = 0; d < history.length_mm.cols(); ++d) {
      const double flat_mm = history.flat_mm[d];
      if (std::abs(history.length_mm(row, d) - flat_mm) <= *limit * flat_mm) continue;
      if (!actuation.over_stroke) actuation.over_stroke = {history.stations[row].pilot_deg, {}};
      std::vector<int>& over = actuation.over_stroke->diagonals;
      const auto at = std::lower_bound(over.begin(), over.end(), d);
      if (at == over.end() || *at != d) over.insert(at, static_cast<int>(d));
    }
  }
}

// |d way / d span| at each row but the first, by the parabola through three neighbours. Both go on
// smoothly through a fold limit, where neither does with the pilot.
std::vector<double> advantages(const std::vector<double>& way_mm,
                               const std::vector<double>& span_mm) {
  std::vector<double> advantages{std::numeric_limits<double>::quiet_NaN()};
  const std::size_t rows = way_mm.size();
  const auto slope = [&](std::size_t i) {
    return (span_mm[i + 1] - span_mm[i]) / (way_mm[i + 1] - way_mm[i]);
  };
  for (std::size_t row = 1; row < rows; ++row) {
    const std::size_t middle = rows == 2 ? 0 : std::min(row, rows - 2);
    double rate = slope(middle);
    if (middle > 0) {
      const double before_mm = way_mm[middle] - way_mm[middle - 1],
                   after_mm = way_mm[middle + 1] - way_mm[middle];
      const double at_mm = row == middle ? before_mm : before_mm + 2 * after_mm;
      const double bend = (slope(middle) - slope(middle - 1)) / (before_mm + after_mm);
      rate = slope(middle - 1) + bend * at_mm;
    }
    advantages.push_back(1 / std::abs(rate));
  }
  return advantages;
}

}  // namespace

Actuation actuate(const Actuators& actuators, const ShapedPath& path,
                  const FlatVertices& vertices_mm) {
  const FoldingHistory& history = path.history;
  const Index stations = history.length_mm.rows(), diagonals = history.length_mm.cols();
  const double k = actuators.stiffness_n_per_mm;
  const auto [a, b] = farthest_apart(vertices_mm);
  Actuation actuation{actuators, {0}, {}, {}, {0}, {0}, {}, {}, {}, {}};
  actuation.force_n.setZero(stations + 1, diagonals);
  actuation.moment_by_n_mm.setZero(stations + 1, diagonals);
  const Eigen::RowVectorXd flat_mm = Eigen::RowVectorXd::Map(history.flat_mm.data(), diagonals);
  Eigen::RowVectorXd before_mm = flat_mm;
  std::vector<double> way_mm{0}, span_mm{(vertices_mm.col(a) - vertices_mm.col(b)).norm()};
  for (Index row = 0; row < stations; ++row) {
    const Eigen::RowVectorXd stretch_mm = history.length_mm.row(row) - flat_mm;
    actuation.pilot_deg.push_back(history.stations[row].pilot_deg);
    actuation.force_n.row(row + 1) = k * stretch_mm;
    actuation.moment_by_n_mm.row(row + 1) =
        k * stretch_mm.cwiseProduct(history.slope_mm_per_deg.row(row)) / kRadPerDeg;
    actuation.energy_n_mm.push_back(k / 2 * stretch_mm.squaredNorm());
    actuation.moment_n_mm.push_back(actuation.moment_by_n_mm.row(row + 1).sum());
    const Eigen::Matrix3Xd& shape_mm = path.shapes_mm[row];
    span_mm.push_back((shape_mm.col(a) - shape_mm.col(b)).norm());
    way_mm.push_back(way_mm.back() + (history.length_mm.row(row) - before_mm).cwiseAbs().sum());
    before_mm = history.length_mm.row(row);
  }
  actuation.mechanical_advantage = advantages(way_mm, span_mm);
  find_weakest(history, actuation);
  find_over_stroke(history, actuation);
  return actuation;
}

}  // namespace misalign::solver
