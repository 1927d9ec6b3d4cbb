#include "search/sheets/better_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "search/draws/models.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/found_study.hpp"
#include "search/sheets/row_certifier.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

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

// What moves together within the base's parallel family, of which the sheet is a member.
void keep_to_family(const solver::Sheet& sheet, solver::OptimiseOptions& options) {
  const auto refuse = [](const std::string& why, const char* instead) {
    throw schema::UserError(solver::OptionFault{"within_family", {}, why, instead});
  };
  auto found = solver::ParallelFamily::of(sheet.base(), options.shifted);
  if (const auto* none = std::get_if<solver::NoParallelFamily>(&found)) {
    refuse("this base has no parallel family: " + none->why(sheet.base().sheet), "take it out");
  }
  const auto& family = std::get<solver::ParallelFamily>(found);
  if (solver::parallel_misfit(sheet.base(), sheet.shifts_mm()).mm > solver::kMemberWithin_mm) {
    refuse("the sheet that it starts from is no member of the base's parallel family",
           "begin with one that `misalign construct` makes");
  }
  options.shifted = family.vertices();
  options.moves = family.basis();
}

schema::OptimiseBounds bounds_of(const std::vector<std::string>& subject_to) {
  schema::OptimiseBounds bounds;
  for (const std::string& text : subject_to) {
    const auto fault = schema::add_bound(text, bounds);
    if (!fault) continue;
    throw schema::UserError(
        solver::OptionFault{"subject_to", schema::printable(text), fault->why, fault->suggestion});
  }
  return bounds;
}

// Of two limits the one that holds.
std::optional<double> lower(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

// Margins are up to a threshold, which the model of a single sheet has not.
bool needs_threshold(const solver::OptimiseOptions& options) {
  const auto is_margin = [](solver::OptimiseGoal goal) {
    return goal == solver::OptimiseGoal::miscut_margin;
  };
  return is_margin(options.goal) ||
         std::ranges::any_of(options.floors, is_margin, &solver::OptimiseFloor::of);
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
  const schema::OptimiseBounds bounds = bounds_of(input.subject_to);
  options.stroke_limit = lower(bounds.stroke_max, design.stroke_limit);
  options.largest_force_n = lower(bounds.largest_force_n, design.largest_force_n);
  options.floors = bounds.floors;
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
  if (input.within_family) {
    if (!chosen.drawn) options.shifted = solver::all_vertices(sheet.base().sheet);
    keep_to_family(sheet, options);
  }
  options.grid_mm = input.grid_mm.value_or(0);
  const double sample = std::ceil(deploys_from_deg / sheet.model().sample_deg() - 1e-9);
  options.deploys_from_sample = std::max(1, static_cast<int>(sample));
  std::unique_ptr<const solver::Model> up_to_there;
  if (needs_threshold(options)) {
    schema::Campaign campaign = chosen.drawn ? chosen.drawn->campaign : chosen.as_campaign();
    campaign.threshold_deg = options.deploys_from_sample * campaign.sample_deg;
    campaign.misalignment.vertices = options.shifted;
    up_to_there.reset(new solver::Model(model_of(campaign)));
  }
  solver::SheetSolver solver(up_to_there ? *up_to_there : sheet.model());
  Eigen::Matrix2Xd shifts_mm = sheet.shifts_mm();
  if (input.grid_mm) shifts_mm = (shifts_mm.array() / *input.grid_mm).round() * *input.grid_mm;
  const solver::Sheet start(solver, shifts_mm, sheet.name());
  return proven(subject,
                found(solver::optimise(start, options), sheet.name() + ": its path is lost"),
                options.deploys_from_sample * sheet.model().sample_deg());
}

schema::Json better_pattern(const Subject& subject, const ProvenBetter& better) {
  const FoldingModel& model = subject.model;
  return schema::pattern_file_json(model.base(), better.found.best().shifts_mm, model.sampling(),
                                   model.design());
}

}  // namespace misalign::search
