#include "solver/optimise/optimise.hpp"

#include <cassert>
#include <cmath>

#include "solver/optimise/ascent.hpp"
#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/objective.hpp"

namespace misalign::solver {
namespace {

std::optional<OptionFault> shifts_fault(const Sheet& start, const OptimiseOptions& options) {
  const double amplitude_mm = options.amplitude_mm;
  if (amplitude_mm <= 0) {
    return OptionFault{"amplitude_mm", shown("%g", amplitude_mm),
                       "leaves no room: the sheet that it starts from is not shifted either",
                       "name one, such as 0.4"};
  }
  for (const int vertex : options.shifted) {
    for (const double shift_mm : start.shifts_mm().col(vertex)) {
      if (on_grid(shift_mm, options.grid_mm) != shift_mm) {
        return OptionFault{"grid_mm", shown("%g", options.grid_mm),
                           "the sheet that it starts from has a shift of " + shown("%g", shift_mm) +
                               " mm, which does not lie on it",
                           "name another one, or none"};
      }
      const bool is_level = shift_mm == 0 || std::abs(shift_mm) == amplitude_mm;
      if (std::abs(shift_mm) > amplitude_mm * (1 + 1e-12) || (options.ternary && !is_level)) {
        return OptionFault{
            "amplitude_mm", shown("%g", amplitude_mm),
            "the sheet that it starts from has a shift of " + shown("%g", shift_mm) + " mm" +
                (options.ternary ? ", and ternary shifts are 0 or the amplitude" : ""),
            options.ternary ? "leave out ternary, or name its own amplitude" : "name a larger one"};
      }
    }
  }
  const double d_deg = start.deploys_from_deg(),
               wanted_deg = start.sample_deg(options.deploys_from_sample);
  if (d_deg < wanted_deg) {
    return OptionFault{"deploys_from_deg", shown("%g", wanted_deg),
                       "the sheet that it starts from deploys from " + shown("%g", d_deg) + " deg",
                       "name no more than that, or another sheet"};
  }
  return {};
}

}  // namespace

StudyResult<Optimised> fitted_start(const Sheet& start, const OptimiseOptions& options) {
  assert(!options.shifted.empty() && options.deploys_from_sample > 0);
  assert(options.moves.size() == 0 || options.moves.rows() == 2 * std::ssize(options.shifted));
  if (start.model().is_overconstrained()) return NoResult::overconstrained;
  const auto& energy = start.model().criterion().energy;
  const Fill& fill = options.deploying.sheet.fill;
  const bool is_followed =
      options.goal->chooses_springs ? are_plain_springs(fill) : are_like_springs(fill);
  if (!is_followed || (energy && !are_plain_springs(energy->fill))) {
    return OptionFault{
        "fill",
        {},
        "an ascent follows the forces of springs of one rate, on all diagonals or on one a hole, "
        "which push, too",
        "give such springs, and choose others or plates for the sheet that it finds"};
  }
  const StudyResult<ReleaseOptions> fitted = validated_release(start, options.deploying);
  if (!fitted) return fitted.obstacle();
  if (auto fault = shifts_fault(start, options)) return *fault;
  OptimiseOptions from = options;
  from.deploying.from_deg = fitted->motion.from_deg;
  if (!is_strong_enough(start, from)) {
    return OptionFault{"largest_force_n", shown("%g", *options.largest_force_n),
                       "a spring of the sheet that it starts from pulls or pushes with more",
                       "name a larger one, weaker springs, or another sheet"};
  }
  if (!fits(start, from)) {
    return OptionFault{"stroke_limit", shown("%g", options.stroke_limit.value_or(0)),
                       "a diagonal of the sheet that it starts from elongates by more",
                       "name a larger one, or another sheet"};
  }
  GoalValues values(start, from);
  for (const OptimiseFloor& floor : from.floors) {
    const auto its = values.value(*floor.goal);
    if (its && *its >= floor.least) continue;
    const Goal& goal = *floor.goal;
    return OptionFault{
        "subject_to",
        std::string(goal.name) + " " + goal.relation() + shown(" %g", goal.in_unit(floor.least)),
        its ? "the sheet that it starts from has " + shown("%.4g", goal.in_unit(*its))
            : "of the sheet that it starts from it is not known",
        goal.is_to_be_small ? "allow more, or begin with another sheet"
                            : "ask for less, or begin with another sheet"};
  }
  const std::optional<double> value = values.value(*from.goal);
  const bool has_any_sign = from.goal->is_to_be_small || from.goal->has_any_sign;
  if (!value || (*value <= 0 && !has_any_sign)) {
    return OptionFault{"goal", {}, from.goal->infeasible, from.goal->suggestion};
  }
  Optimised result{};
  result.from_deg = *from.deploying.from_deg;
  result.taken.push_back({point_of(start.shifts_mm(), from), *value});
  result.options = std::move(from);
  return result;
}

StudyResult<Optimised> optimise(const Sheet& start, const OptimiseOptions& options) {
  StudyResult<Optimised> fitted = fitted_start(start, options);
  if (!fitted) return fitted.obstacle();
  Ascent ascent(start, *std::move(fitted));
  while (!ascent.finished()) ascent.advance();
  return ascent.release();
}

}  // namespace misalign::solver
