#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "search/terminal/count_text.hpp"
#include "solver/optimise/low_slopes.hpp"
#include "solver/records/strokes.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

// Diagonals that are named among active limits.
constexpr std::size_t kMostNamed = 4;

std::string limits_text(const solver::Mechanism& mechanism, const solver::Optimised& found) {
  const solver::Optimised::Limits& limits = *found.limits;
  std::string text = "active limits, and the goal's gain to first order:\n";
  if (limits.per_share_of_stroke > 0) {
    text += fmt::format("  stroke limit: {:.3g} for 1 % more\n", limits.per_share_of_stroke / 100);
  }
  if (limits.per_n_of_force > 0) {
    text += fmt::format("  largest spring force: {:.3g} for 1 N more\n", limits.per_n_of_force);
  }
  if (limits.per_mm_of_amplitude > 0) {
    text += fmt::format("  amplitude: {:.3g} for 0.1 mm more\n", limits.per_mm_of_amplitude / 10);
  }
  if (limits.per_n_per_mm_of_stiffness > 0) {
    text += fmt::format("  spring rate: {:.3g} for 1 N/mm beyond its limit\n",
                        limits.per_n_per_mm_of_stiffness);
  }
  if (limits.per_n_of_preload > 0) {
    text += fmt::format("  preload: {:.3g} for 1 N beyond its limit\n", limits.per_n_of_preload);
  }
  for (std::size_t k = 0; k < found.options.floors.size(); ++k) {
    if (limits.per_floor[k] == 0) continue;
    const auto& [goal, least] = found.options.floors[k];
    text += fmt::format("  {}: {:.3g} for 1 % {}\n", goal->words,
                        limits.per_floor[k] * std::abs(least) / 100,
                        goal->is_to_be_small ? "more" : "less");
  }
  for (std::size_t k = 0; k < std::min(kMostNamed, limits.turning.size()); ++k) {
    const auto& [diagonal, pilot_deg, per_mm] = limits.turning[k];
    text += fmt::format("  diagonal {} reverses near {:g} deg\n",
                        schema::diagonal_label(mechanism, diagonal), pilot_deg);
  }
  if (limits.turning.size() > kMostNamed) {
    text += fmt::format("  and {} more diagonals\n", limits.turning.size() - kMostNamed);
  }
  if (limits.energy_deg) text += fmt::format("  total energy at {:.0f} deg\n", *limits.energy_deg);
  if (limits.by_fold_limit) text += "  fold limit\n";
  return text;
}

// Some goals depend on an angle of use.
std::string goal_text(const solver::Optimised& found) {
  const solver::Goal& goal = *found.options.goal;
  return goal.is_of_use ? fmt::format("{} from {:g} deg", goal.words, found.from_deg) : goal.words;
}

std::string springs_text(const solver::Optimised& found) {
  std::string text;
  const solver::DesignPoint& best = found.best();
  if (found.options.stiffness_n_per_mm)
    text += fmt::format(" of {:.4g} N/mm", best.stiffness_n_per_mm);
  if (found.options.preload_n)
    text += fmt::format(" preloaded with {:.4g} N at flat", best.preload_n);
  return text.empty() ? text : "springs" + text + "\n";
}

// An ascent only keeps a start below the floor from getting worse.
std::string slope_text(const solver::Sheet& sheet, const solver::Optimised& found) {
  const solver::OptimiseOptions& options = found.options;
  if (options.ternary || sheet.model().is_overconstrained() || sheet.model().criterion().energy) {
    return {};
  }
  const double least =
      solver::least_slope_mm_per_deg(sheet, sheet.sample_deg(options.deploys_from_sample));
  if (least >= options.least_slope_mm_per_deg) return {};
  return fmt::format("least slope {:.3g} mm/deg, below the requested {:g}\n", least,
                     options.least_slope_mm_per_deg);
}

}  // namespace

std::string optimise_text(const Subject& subject, const solver::Sheet& sheet,
                          const ProvenBetter& better) {
  const auto& [found, certified_deg] = better;
  const solver::Goal& goal = *found.options.goal;
  std::string text = fmt::format(
      "{}: {} {:.4g} {}, now {:.4g}; {}, {} folded{}\n", subject.sheet.name(), goal_text(found),
      goal.in_unit(found.start().value), goal.unit_words, goal.in_unit(found.best().value),
      count_text(static_cast<std::uint64_t>(found.steps()), "step"),
      count_text(static_cast<std::uint64_t>(found.evaluations), "sheet"),
      found.stop_reason == solver::Optimised::StopReason::most_steps ? ", not converged" : "");
  const std::optional<double>& used_deg = found.options.used_from_deg;
  text += fmt::format(
      "deploys from {:g} deg{}; largest stroke {:.3g} % from {:g} deg, shifts up to {:.4g} mm\n",
      sheet.deploys_from_deg(),
      certified_deg ? fmt::format(", proven up to {:g}", *certified_deg) : "",
      100 * solver::largest_stroke(sheet.history(), solver::rows_of_use(sheet, used_deg)),
      solver::angle_of_use(sheet, used_deg), found.best().shifts_mm.cwiseAbs().maxCoeff());
  text += springs_text(found) + slope_text(sheet, found);
  if (found.limits) text += limits_text(sheet.mechanism(), found);
  return text;
}

}  // namespace misalign::search
