#include "solver/optimise/objective.hpp"

#include <algorithm>
#include <cassert>

#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/low_slopes.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

// Least distance of creases from folded flat: more than rounding, less than what steps leave.
constexpr double kFromFlat_deg = 1e-4;

// Stroke up to the angle of use, by samples and that angle; up to D as in catalogues.
double stroke(const Sheet& sheet, const OptimiseOptions& options) {
  if (!options.used_from_deg) {
    return measure(sheet.model(), sheet.vertices_mm(), sheet.record()).stroke_max;
  }
  const FoldingWay& way = *sheet.way();
  const double used_deg = std::min(angle_of_use(sheet, options.used_from_deg), way.end_deg());
  Eigen::VectorXd lengths_mm, rates_mm;
  double largest = 0;
  for (int sample = 1;; ++sample) {
    const double pilot_deg = std::min(sheet.sample_deg(sample), used_deg);
    way.find_lengths(way.x_of(pilot_deg), lengths_mm, rates_mm);
    const auto shares = lengths_mm.array() / way.flat_mm().array() - 1;
    largest = std::max(largest, shares.abs().maxCoeff());
    if (pilot_deg == used_deg) return largest;
  }
}

double force_n(const Sheet& sheet, const ReleaseOptions& deploying) {
  assert(sheet.way() && deploying.from_deg);
  const EnergyModel rigid(sheet, deploying.sheet);
  return rigid.filling_forces_n(sheet.way()->x_of(*deploying.from_deg)).cwiseAbs().maxCoeff();
}

// Returns whether the sheet is judged by its total energy: then diagonals need not be monotone.
bool is_by_energy(const Sheet& sheet) { return sheet.model().criterion().energy.has_value(); }

// Returns whether all goals with floors keep them.
bool keeps_floors(GoalValues& values) {
  return std::ranges::all_of(values.options().floors, [&](const OptimiseFloor& floor) {
    const auto value = values.value(*floor.goal);
    return value && *value >= floor.least;
  });
}

}  // namespace

bool is_strong_enough(const Sheet& sheet, const OptimiseOptions& options) {
  return !options.largest_force_n || force_n(sheet, options.deploying) <= *options.largest_force_n;
}

bool fits(const Sheet& sheet, const OptimiseOptions& options) {
  return sheet.verdict().deploys_from_sample >= options.deploys_from_sample && sheet.way() &&
         sheet.way()->end_deg() > *options.deploying.from_deg &&
         (!options.stroke_limit || stroke(sheet, options) <= *options.stroke_limit) &&
         is_strong_enough(sheet, options);
}

bool goes_all_the_way(const Sheet& sheet, const OptimiseOptions& options) {
  assert(sheet.way() && options.deploys_from_sample > 0);
  const double to_deg = sheet.sample_deg(options.deploys_from_sample);
  const auto& reverses_deg = sheet.record().extremes.reverses_deg;
  if (!is_by_energy(sheet) && reverses_deg && *reverses_deg <= to_deg) return false;
  if (sheet.way()->end_deg() < to_deg) return true;  // its end is the sample, except for rounding
  // The pose is solved: ways are inexact by thousandths of a degree between stations, next to
  // limits by more.
  const Sheet::Pose& pose = sheet.at(to_deg);
  return pose.is_closed && pose.fold_deg.cwiseAbs().maxCoeff() <= 180 - kFromFlat_deg;
}

bool keeps_slope(const Sheet& sheet, const Sheet& before, const OptimiseOptions& options) {
  if (is_by_energy(sheet) || !options.slope_at_every_angle || options.ternary) return true;
  const double to_deg = sheet.sample_deg(options.deploys_from_sample),
               least = least_slope_mm_per_deg(sheet, to_deg);
  return least >= options.least_slope_mm_per_deg || least >= least_slope_mm_per_deg(before, to_deg);
}

std::optional<double> objective(const Sheet& sheet, const OptimiseOptions& options) {
  if (!fits(sheet, options) || !goes_all_the_way(sheet, options)) return {};
  GoalValues values(sheet, options);
  return keeps_floors(values) ? values.value(*options.goal) : std::nullopt;
}

}  // namespace misalign::solver
