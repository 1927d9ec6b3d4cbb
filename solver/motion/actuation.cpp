#include "solver/motion/actuation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/continuation/path.hpp"
#include "solver/records/metrics.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Returns the row of the actuation at the angle of use.
Index row_of_use(const Sheet& sheet, std::optional<double> from_deg) {
  if (!from_deg) return sheet.rows_up_to_d();
  const std::optional<Index> row = sheet.row_at(*from_deg);
  assert(row);
  return *row + 1;
}

// Returns whether a row is a sample up to the angle of use, or that angle.
bool is_used(const FoldingHistory& history, const Actuation& actuation, std::size_t station) {
  assert(station < history.stations.size());
  const auto row = static_cast<Index>(station) + 1;
  if (row > actuation.from_row) return false;
  const int sample = history.stations[station].sample;
  return row == actuation.from_row || (sample > 0 && sample <= history.verdict.deploys_from_sample);
}

std::vector<Index> judged_rows(const FoldingHistory& history, const Actuation& actuation) {
  std::vector<Index> rows;
  for (std::size_t i = 0; i < history.stations.size(); ++i) {
    if (is_used(history, actuation, i) && history.stations[i].pilot_deg >= kSlopeFrom_deg) {
      rows.push_back(static_cast<Index>(i) + 1);
    }
  }
  return rows;
}

void find_weakest(const FoldingHistory& history, Actuation& actuation) {
  const std::vector<Index> rows = judged_rows(history, actuation);
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
    if (!is_used(history, actuation, static_cast<std::size_t>(row))) continue;
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

std::vector<double> free_lengths_mm(const Sheet& sheet, const Actuators& actuators) {
  const FoldingHistory& history = sheet.history();
  std::vector<double> free_mm = history.flat_mm;
  if (!actuators.preload.is_any() || history.length_mm.rows() == 0) return free_mm;
  assert(actuators.stiffness_n_per_mm > 0);
  const Eigen::VectorXd preload_n = actuators.preload.forces_n(sheet.mechanism().diagonals);
  for (std::size_t d = 0; d < free_mm.size(); ++d) {
    const bool lengthens = history.length_mm(0, static_cast<Index>(d)) > free_mm[d];
    free_mm[d] -=
        (lengthens ? 1 : -1) * preload_n(static_cast<Index>(d)) / actuators.stiffness_n_per_mm;
  }
  return free_mm;
}

// The diagonals' rates over the span's. Both are zero in flat sheets and where a sheet lies folded
// flat: then there is no advantage.
double advantage(const FoldingHistory& history, Index row, double span_mm_per_deg) {
  assert(row >= 0 && row < history.slope_mm_per_deg.rows());
  constexpr double kStill = 1e-9;  // error of rates, in the diagonals' lengths per radian
  const double still_mm_per_deg =
      kStill * kRadPerDeg * std::reduce(history.flat_mm.begin(), history.flat_mm.end());
  if (std::abs(span_mm_per_deg) <= still_mm_per_deg) return kNone;
  return history.slope_mm_per_deg.row(row).cwiseAbs().sum() / std::abs(span_mm_per_deg);
}

}  // namespace

double Actuation::largest_force_n() const {
  assert(from_row >= 0 && from_row < force_n.rows());
  return force_n.topRows(from_row + 1).cwiseAbs().maxCoeff();
}

Actuation actuate(const Sheet& sheet, const Actuators& actuators, std::optional<double> from_deg) {
  const FoldingHistory& history = sheet.history();
  const Index stations = history.length_mm.rows(), diagonals = history.length_mm.cols();
  const double k = actuators.stiffness_n_per_mm;
  Actuation actuation{.actuators = actuators,
                      .from_deg = from_deg,
                      .from_row = row_of_use(sheet, from_deg),
                      .pilot_deg = {0},
                      .free_mm = free_lengths_mm(sheet, actuators),
                      .force_n = {},
                      .moment_by_n_mm = {},
                      .energy_n_mm = {},
                      .moment_n_mm = {0},
                      .mechanical_advantage = {kNone},
                      .weakest = {},
                      .few = {},
                      .over_stroke = {}};
  actuation.force_n.setZero(stations + 1, diagonals);
  assert(actuation.from_row <= stations);
  actuation.moment_by_n_mm.setZero(stations + 1, diagonals);
  using Lengths = Eigen::Map<const Eigen::RowVectorXd>;
  const Lengths free_mm(actuation.free_mm.data(), diagonals);
  const Eigen::RowVectorXd preloaded_mm = Lengths(history.flat_mm.data(), diagonals) - free_mm;
  actuation.force_n.row(0) = k * preloaded_mm;
  actuation.energy_n_mm.push_back(k / 2 * preloaded_mm.squaredNorm());
  for (Index row = 0; row < stations; ++row) {
    const Eigen::RowVectorXd stretch_mm = history.length_mm.row(row) - free_mm;
    actuation.pilot_deg.push_back(history.stations[row].pilot_deg);
    actuation.force_n.row(row + 1) = k * stretch_mm;
    actuation.moment_by_n_mm.row(row + 1) =
        k * stretch_mm.cwiseProduct(history.slope_mm_per_deg.row(row)) / kRadPerDeg;
    actuation.energy_n_mm.push_back(k / 2 * stretch_mm.squaredNorm());
    actuation.moment_n_mm.push_back(actuation.moment_by_n_mm.row(row + 1).sum());
    actuation.mechanical_advantage.push_back(
        advantage(history, row, sheet.span_slope_mm_per_deg()[static_cast<std::size_t>(row)]));
  }
  find_weakest(history, actuation);
  find_over_stroke(history, actuation);
  return actuation;
}

}  // namespace misalign::solver
