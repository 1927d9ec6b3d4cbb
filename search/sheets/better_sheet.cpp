#include "search/sheets/better_sheet.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "schema/pattern/fill_words.hpp"
#include "search/draws/models.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/shaped.hpp"
#include "search/sheets/studies.hpp"
#include "search/sheets/tolerance.hpp"
#include "search/terminal/long_work.hpp"
#include "solver/optimise/chosen_friction.hpp"
#include "solver/pattern/parallel_family.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::search {
namespace {

// The angle up to which the optimum must be proven: the requested one, or where an angle is the
// goal the last sample before it.
double asked_deg(const solver::Optimised& found, double sample_deg) {
  const double asked_deg = found.options.deploys_from_sample * sample_deg;
  if (!found.options.goal->is_proven_angle) return asked_deg;
  return std::max(asked_deg, std::floor(found.best().value / sample_deg) * sample_deg);
}

// Keeps the last sheet proven up to there; all sheets where not even the start is.
ProvenBetter proven(const Subject& subject, solver::Optimised found,
                    const std::function<void()>& watch) {
  if (!subject.sheet.base().springs.in_mid_plane()) return {std::move(found), {}};
  RowCertifier certifier(
      subject.chosen.base, subject.sheet.model(),
      claims_of(subject.chosen.base, subject.chosen.sampling, subject.chosen.design));
  std::optional<double> first;
  const std::vector<solver::Optimised::Taken> all = found.taken;
  for (;;) {
    watch();
    const double to_deg = asked_deg(found, subject.sheet.model().sample_deg());
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

// Restricts shifts to the base's parallel family, of which the sheet is a member.
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

// Returns the tighter of two limits.
std::optional<double> lower(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

// Names the violated constraint by --subject-to where that, and no limit of springs, sets it.
solver::StudyResult<solver::Optimised> called_by(const schema::OptimiseBounds& bounds,
                                                 solver::StudyResult<solver::Optimised> study) {
  if (!study.fault()) return study;
  solver::OptionFault fault = *study.fault();
  for (const auto& [name, limit, bound] :
       {std::tuple("stroke_limit", "stroke_max", bounds.stroke_max),
        std::tuple("largest_force_n", "largest_force_n", bounds.largest_force_n)}) {
    if (fault.name != name || !bound || fault.value != fmt::format("{:g}", *bound)) continue;
    fault = {"subject_to", std::string(limit) + " <= " + *fault.value, fault.why, fault.suggestion};
  }
  return fault;
}

// Returns whether the goal, or that of a floor, has this need.
bool needs(const solver::OptimiseOptions& options, bool solver::Goal::*need) {
  return options.goal->*need ||
         std::ranges::any_of(options.floors, need, &solver::OptimiseFloor::goal);
}

constexpr double kMiscut_mm = 0.05;

using Range = solver::OptimiseOptions::Range;

// The range of a spring's quantity, which contains its start.
std::optional<Range> range_of(const char* option, std::string_view design_key,
                              const std::vector<double>& bounds, double start) {
  if (bounds.empty()) return {};
  const double least = bounds.front(), most = bounds.back();
  const std::string shown = fmt::format("{:g}", fmt::join(bounds, ","));
  const auto refuse = [&](const std::string& why, const std::string& instead) {
    throw schema::UserError(solver::OptionFault{option, shown, why, instead});
  };
  if (bounds.size() != 2) refuse("are not two numbers", "give the least and the most");
  if (!(least < most)) refuse("the least is not below the most", "write the smaller one first");
  const auto [lowest, highest] = schema::design_limits(design_key);
  if (!(least >= lowest && most <= highest)) {
    refuse(fmt::format("springs may have {:g} to {:g}", lowest, highest),
           "name limits within that");
  }
  if (start < least || start > most) {
    refuse(fmt::format("the springs that it starts from have {:g}", start),
           "name limits on both sides of that, or other starting springs");
  }
  return Range{least, most};
}

// Copies are those of `misalign tolerance`, and deploy from the requested angle.
void add_yield(const ChosenSheet& chosen, const OptimiseInput& input, const schema::Campaign& asked,
               solver::OptimiseOptions& options) {
  const double miscut_mm = input.miscut_mm.value_or(chosen.design.miscut_mm.value_or(kMiscut_mm));
  check_miscut(miscut_mm, chosen.base.base.sheet, chosen.shifts_mm, chosen.name());
  options.yield =
      [asked, copies = ToleranceOptions{.amplitude_mm = miscut_mm,
                                        .trials = input.trials,
                                        .jobs = input.jobs,
                                        .set = solver::available_instruction_sets().back(),
                                        .progress = [watch = input.watch](const CopiesDone&) {
                                          watch();
                                        }}](const solver::Sheet& sheet) -> std::optional<double> {
    const solver::Tolerance found = study_tolerance(asked, {sheet.shifts_mm()}, copies).front();
    if (found.copies.decided() == 0) return {};
    return static_cast<double>(found.survivors()) / static_cast<double>(found.copies.decided());
  };
}

void choose_springs(const OptimiseInput& input, solver::OptimiseOptions& options) {
  solver::Springs& springs = options.deploying.sheet.springs();
  springs.rest_deg = input.rest_deg.value_or(springs.rest_deg);
  if (options.goal->chooses_springs &&
      (springs.rest_deg != 0 || springs.preload.is_any() || !input.preload_n.empty())) {
    throw schema::UserError(solver::OptionFault{
        "goal", std::string(options.goal->name),
        "chooses a free length for each spring, and these have an angle of rest or a preload",
        "take these out"});
  }
  options.stiffness_n_per_mm = range_of("stiffness_within", "springs.stiffness_n_per_mm",
                                        input.stiffness_n_per_mm, springs.stiffness_n_per_mm);
  options.preload_n =
      range_of("preload_within", "springs.preload_n", input.preload_n, springs.preload.each_n);
  if (options.preload_n && !springs.preload.others.empty()) {
    throw schema::UserError(solver::OptionFault{
        "preload_within", {}, "the design has preloads of single springs", "take these out"});
  }
}

// The target of a file, for goals that need one.
std::shared_ptr<const solver::ShapeMeasure> target_measure(const Subject& subject,
                                                           solver::SheetSolver& solver,
                                                           const solver::OptimiseOptions& options) {
  const ChosenSheet& chosen = subject.chosen;
  if (chosen.drawn) {
    throw schema::UserError(
        schema::Cause::bad_request,
        chosen.name() + R"(: has no target, of which goals of a shape need one; export it, )"
                        R"(write "target" into its file, and name that)");
  }
  const schema::Target& target = target_of(chosen.target, chosen.name());
  const double rest_deg = options.deploying.sheet.springs().rest_deg,
               at_deg = shape_deg(target, rest_deg > 0 ? std::optional(rest_deg) : std::nullopt);
  auto measure = solver::ShapeMeasure::of(solver, target.shape, at_deg);
  if (!measure) {
    throw schema::UserError(schema::Cause::bad_input,
                            fmt::format("{}: its base does not fold to the target's angle, {:g} "
                                        "deg; write a smaller \"at_deg\" into its \"target\"",
                                        chosen.name(), at_deg));
  }
  return std::make_shared<const solver::ShapeMeasure>(*std::move(measure));
}

// Adds the limits of an optimisation that a card requires, too.
schema::Design with_limits(schema::Design design, const solver::OptimiseOptions& options) {
  if (options.stroke_limit) design.stroke_limit = options.stroke_limit;
  if (options.largest_force_n) design.largest_force_n = options.largest_force_n;
  for (const auto& [goal, least] : options.floors) {
    for (const auto& [name, number] : {std::pair("thickness_mm", &schema::Design::thickness_mm),
                                       std::pair("yield", &schema::Design::yield)}) {
      if (goal->name == std::string_view(name)) {
        design.*number = std::max((design.*number).value_or(least), least);
      }
    }
  }
  return design;
}

}  // namespace

solver::OptimiseOptions options_of(const schema::OptimiseRequest& request) {
  solver::OptimiseOptions options;
  options.goal = request.goal;
  options.floors = request.bounds.floors;
  options.stroke_limit = request.bounds.stroke_max;
  options.largest_force_n = request.bounds.largest_force_n;
  options.ternary = request.ternary;
  options.grid_mm = request.grid_mm.value_or(0);
  options.least_slope_mm_per_deg = request.least_slope_mm_per_deg;
  options.most_steps = static_cast<int>(request.most_steps);
  return options;
}

ProvenBetter optimised(const Subject& subject, const OptimiseInput& input) {
  const auto& [chosen, model, sheet] = subject;
  const schema::Design& design = model.design();
  solver::OptimiseOptions options = options_of(input);
  options.used_from_deg = design.from_deg;
  options.deploying = deploy_options(design, sheet);
  schema::need_like_springs(options.deploying.sheet.fill, "`misalign optimise`");
  options.bending = bending(design);
  options.stroke_limit = lower(options.stroke_limit, design.stroke_limit);
  options.largest_force_n = lower(options.largest_force_n, design.largest_force_n);
  options.tries_flips = input.tries_flips;
  options.bodies = design.spring_bodies();
  options.watch = input.watch;
  options.see_steps = [most = input.most_steps](int steps) {
    show_work("steps at most", static_cast<std::uint64_t>(steps), static_cast<std::uint64_t>(most));
  };
  options.slope_at_every_angle = true;
  options.shifted = solver::interior_vertices(sheet.base().sheet);
  options.amplitude_mm = input.amplitude_mm.value_or(sheet.shifts_mm().cwiseAbs().maxCoeff());
  const std::optional<double> named_deg =
      input.deploys_from_deg ? input.deploys_from_deg : design.from_deg;
  double deploys_from_deg = named_deg.value_or(sheet.deploys_from_deg());
  if (chosen.drawn) {
    const schema::Campaign& campaign = chosen.drawn->campaign;
    options.shifted = campaign.misalignment.vertices;
    options.amplitude_mm = input.amplitude_mm.value_or(campaign.misalignment.amplitude_mm);
    deploys_from_deg = named_deg.value_or(campaign.threshold_deg);
  }
  if (input.with_rim) options.shifted = solver::all_vertices(sheet.base().sheet);
  if (input.within_family) {
    if (!chosen.drawn) options.shifted = solver::all_vertices(sheet.base().sheet);
    keep_to_family(sheet, options);
  }
  const double sample = std::ceil(deploys_from_deg / sheet.model().sample_deg() - 1e-9);
  options.deploys_from_sample = std::max(1, static_cast<int>(sample));
  choose_springs(input, options);
  std::unique_ptr<const solver::Model> up_to_there;
  if (needs(options, &solver::Goal::needs_threshold)) {
    schema::Campaign campaign = chosen.drawn ? chosen.drawn->campaign : chosen.as_campaign();
    campaign.threshold_deg = options.deploys_from_sample * campaign.sample_deg;
    if (needs(options, &solver::Goal::needs_copies)) add_yield(chosen, input, campaign, options);
    campaign.misalignment.vertices = options.shifted;
    up_to_there.reset(new solver::Model(model_of(campaign)));
  }
  solver::SheetSolver solver(up_to_there ? *up_to_there : sheet.model());
  if (needs(options, &solver::Goal::needs_target)) {
    options.shape = target_measure(subject, solver, options);
  }
  Eigen::Matrix2Xd shifts_mm = sheet.shifts_mm();
  if (input.grid_mm) shifts_mm = (shifts_mm.array() / *input.grid_mm).round() * *input.grid_mm;
  const solver::Sheet start(solver, shifts_mm, sheet.name());
  return proven(subject,
                value_or_throw(called_by(input.bounds, solver::optimise(start, options)),
                               sheet.name(), "no better sheet is sought"),
                input.watch);
}

schema::Json better_pattern(const Subject& subject, const ProvenBetter& better) {
  const FoldingModel& model = subject.model;
  const solver::Optimised& found = better.found;
  schema::Design design = with_limits(model.design(), found.options);
  if (found.options.stiffness_n_per_mm) design.stiffness_n_per_mm = found.best().stiffness_n_per_mm;
  if (found.options.preload_n) design.preload_n = found.best().preload_n;
  if (const double at_deg = found.options.deploying.sheet.springs().rest_deg; at_deg != 0) {
    design.rest_deg = at_deg;
  }
  if (found.options.goal->chooses_springs) {
    solver::SheetSolver solver(subject.sheet.model());
    const solver::Sheet best(solver, found.best().shifts_mm);
    solver::ReleaseOptions deploying = found.options.deploying;
    deploying.sheet.springs().stiffness_n_per_mm = found.best().stiffness_n_per_mm;
    const auto choice = value_or_throw(
        solver::choose_springs(best, solver::choice_of(deploying, found.options.bending.to_deg)),
        best.name(), "its springs are not chosen");
    design.single_springs = choice.filling(best.mechanism()).single;
  }
  return schema::pattern_file_json(model.base(), found.best().shifts_mm, model.sampling(), design,
                                   subject.chosen.target);
}

}  // namespace misalign::search
