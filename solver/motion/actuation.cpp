#include "solver/motion/actuation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/continuation/path.hpp"
#include "solver/records/metrics.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;

// Distance from a stop at which its filling must drive the sheet.
constexpr double kBesideStop_deg = 1;
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
    if (is_used(history, actuation, i) &&
        history.stations[i].pilot_deg >= actuation.counts_from_deg - kSameAngle_deg) {
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
  const bool is_springs = std::holds_alternative<Springs>(actuation.actuators.fill);
  if (is_springs && moments.rowwise().sum().minCoeff() > 0) {
    actuation.few = few_diagonals(moments, kShareOfFew, actuation.actuators.never_both);
  }
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
  const Filling filling = filling_of(sheet, actuators.fill);
  Actuation actuation{.actuators = actuators,
                      .from_deg = from_deg,
                      .from_row = row_of_use(sheet, from_deg),
                      .pilot_deg = {0},
                      .free_mm = {filling.relaxed_mm().begin(), filling.relaxed_mm().end()},
                      .force_n = {},
                      .moment_by_n_mm = {},
                      .energy_n_mm = {},
                      .moment_n_mm = {0},
                      .mechanical_advantage = {kNone},
                      .counts_from_deg = kSlopeFrom_deg,
                      .weakest = {},
                      .few = {},
                      .over_stroke = {}};
  actuation.force_n.setZero(stations + 1, diagonals);
  assert(actuation.from_row <= stations);
  actuation.moment_by_n_mm.setZero(stations + 1, diagonals);
  const auto add = [&](Index row, const Eigen::VectorXd& lengths_mm) {
    actuation.force_n.row(row) = filling.forces_n(lengths_mm);
    actuation.energy_n_mm.push_back(filling.energy_n_mm(lengths_mm));
  };
  add(0, Eigen::VectorXd::Map(history.flat_mm.data(), diagonals));
  for (Index row = 0; row < stations; ++row) {
    add(row + 1, history.length_mm.row(row));
    actuation.pilot_deg.push_back(history.stations[row].pilot_deg);
    actuation.moment_by_n_mm.row(row + 1) =
        actuation.force_n.row(row + 1).cwiseProduct(history.slope_mm_per_deg.row(row)) / kRadPerDeg;
    actuation.moment_n_mm.push_back(actuation.moment_by_n_mm.row(row + 1).sum());
    actuation.mechanical_advantage.push_back(
        advantage(history, row, sheet.span_slope_mm_per_deg()[static_cast<std::size_t>(row)]));
  }
  // A filling that is relaxed there, and pulls back below, stops the sheet.
  const double stop_deg = rest_deg(actuators.fill);
  for (std::size_t row = 1; row < actuation.pilot_deg.size(); ++row) {
    if (actuation.pilot_deg[row] >= stop_deg - kSameAngle_deg) break;
    if (actuation.moment_n_mm[row] >= 0) continue;
    actuation.counts_from_deg = std::max(kSlopeFrom_deg, stop_deg + kBesideStop_deg);
  }
  find_weakest(history, actuation);
  find_over_stroke(history, actuation);
  return actuation;
}

}  // namespace misalign::solver
