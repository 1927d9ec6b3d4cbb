#include "search/sheets/optimise_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/exchange/actuators_json.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/found_study.hpp"
#include "search/sheets/row_certifier.hpp"

namespace misalign::search {
namespace {

// Diagonals that are named as what limits it.
constexpr std::size_t kMostNamed = 4;

std::string limits_text(const solver::Mechanism& mechanism, const solver::Optimised& found) {
  const solver::OptimiseLimits& limits = *found.limits;
  std::string text = "what limits it, to first order:\n";
  if (limits.per_share_of_stroke > 0) {
    text += fmt::format("  the stroke: a limit 1 % larger would give {:.3g} more\n",
                        limits.per_share_of_stroke / 100);
  }
  if (limits.per_n_of_force > 0) {
    text += fmt::format("  the springs: 1 N more that they bear would give {:.3g} more\n",
                        limits.per_n_of_force);
  }
  if (limits.per_mm_of_amplitude > 0) {
    text += fmt::format("  the amplitude: 0.1 mm more would give {:.3g} more\n",
                        limits.per_mm_of_amplitude / 10);
  }
  for (std::size_t k = 0; k < std::min(kMostNamed, limits.turning.size()); ++k) {
    const auto& [diagonal, pilot_deg, per_mm] = limits.turning[k];
    text += fmt::format("  {} would turn back near {:g} deg\n",
                        schema::diagonal_label(mechanism, diagonal), pilot_deg);
  }
  if (limits.turning.size() > kMostNamed) {
    text += fmt::format("  and {} more\n", limits.turning.size() - kMostNamed);
  }
  if (limits.by_fold_limit) text += "  it would not fold that far\n";
  return text;
}

// The last sheet that is proven up to there; where not even the start is, all stay.
ProvenBetter proven(const Subject& subject, solver::Optimised found, double to_deg) {
  if (!subject.sheet.base().springs.in_mid_plane()) return {std::move(found), {}};
  RowCertifier certifier(subject.chosen.base, subject.sheet.model());
  std::optional<double> first;
  const std::vector<solver::Optimised::Taken> all = found.taken;
  for (;;) {
    const auto row = certifier.certify(0, found.best().shifts_mm, to_deg);
    if (!first) first = row.certified_deg;
    if (row.certified_deg >= to_deg) return {std::move(found), row.certified_deg};
    found.limits.reset();
    if (found.steps() == 0) break;
    found.taken.pop_back();
  }
  found.taken = all;
  return {std::move(found), first};
}

}  // namespace

ProvenBetter optimised(const Subject& subject, const OptimiseInput& input) {
  const auto& [chosen, model, sheet] = subject;
  const schema::Design& design = model.design();
  if (sheet.model().has_spare_equations()) {
    throw schema::UserError(schema::Cause::bad_request,
                            sheet.name() +
                                ": has fewer holes than count to one degree of freedom "
                                "(next to it only sheets of its parallel family fold); "
                                "`misalign construct` makes the best of these");
  }
  solver::OptimiseOptions options;
  options.goal = input.goal;
  options.deploying = deploy_options(design, sheet);
  options.bending = bending(design);
  options.stroke_limit = design.stroke_limit;
  options.largest_force_n = design.largest_force_n;
  options.ternary = input.ternary;
  options.least_slope_mm_per_deg = input.least_slope_mm_per_deg;
  options.most_steps = input.most_steps;
  options.shifted = solver::interior_vertices(sheet.base().sheet);
  options.amplitude_mm = input.amplitude_mm.value_or(sheet.shifts_mm().cwiseAbs().maxCoeff());
  double deploys_from_deg = input.deploys_from_deg.value_or(sheet.deploys_from_deg());
  if (chosen.drawn) {
    const schema::Campaign& campaign = chosen.drawn->campaign;
    options.shifted = campaign.misalignment.vertices;
    options.amplitude_mm = input.amplitude_mm.value_or(campaign.misalignment.amplitude_mm);
    deploys_from_deg = input.deploys_from_deg.value_or(campaign.threshold_deg);
  }
  const double sample = std::ceil(deploys_from_deg / sheet.model().sample_deg() - 1e-9);
  options.deploys_from_sample = std::max(1, static_cast<int>(sample));
  return proven(subject,
                found(solver::optimise(sheet, options), sheet.name() + ": its path is lost"),
                options.deploys_from_sample * sheet.model().sample_deg());
}

schema::Json better_pattern(const Subject& subject, const ProvenBetter& better) {
  const FoldingModel& model = subject.model;
  return schema::pattern_file_json(model.base(), better.found.best().shifts_mm, model.sampling(),
                                   model.design());
}

std::string optimise_text(const Subject& subject, const solver::Sheet& sheet,
                          const ProvenBetter& better) {
  const auto& [found, certified_deg] = better;
  std::string text = fmt::format(
      "{}: {} from {:g} deg {:.4g} N mm per mm, now {:.4g}: {} steps, {} sheets folded{}\n",
      subject.sheet.name(), schema::name_of(found.options.goal).words, found.from_deg,
      found.start().value, found.best().value, found.steps(), found.looks,
      found.end == solver::OptimiseEnd::most_steps ? ", and it goes on" : "");
  text +=
      fmt::format("deploys from {:g} deg{}; largest stroke {:.3g} %, shifts up to {:.4g} mm\n",
                  sheet.deploys_from_deg(),
                  certified_deg ? fmt::format(", proven up to {:g}", *certified_deg) : "",
                  100 * sheet.metrics()->stroke_max, found.best().shifts_mm.cwiseAbs().maxCoeff());
  if (found.limits) text += limits_text(sheet.mechanism(), found);
  return text;
}

}  // namespace misalign::search
