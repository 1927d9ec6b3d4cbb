#include "search/sheets/studies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>

#include "schema/exchange/actuators_json.hpp"
#include "schema/files/features.hpp"
#include "search/sheets/deploy_input.hpp"
#include "solver/linear/mobility.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

using schema::Cause;
using schema::UserError;
using solver::NoResult;

// A reason as the parts of a sentence.
struct Reason {
  NoResult reason;
  Cause cause;
  const char* why;
  const char* advice;
};

constexpr Reason kReasons[] = {
    {NoResult::path_lost, Cause::failure, "its folding path is lost (a numerical failure)",
     "`misalign fold` shows how far it is known"},
    {NoResult::panels_not_stable, Cause::failure,
     "the stiffness of its panels is not positive (a numerical failure, as of panels that are too "
     "thin beside their width)",
     "take thicker panels"},
    {NoResult::overconstrained, Cause::bad_request,
     "it is overconstrained: it has fewer holes than one degree of freedom needs (next to it only "
     "sheets of its parallel family fold)",
     "`misalign construct` makes the best of these"}};

void check_freedom(const schema::Pattern& base, const std::string& path) {
  const solver::PerforatedSheet& sheet = base.base;
  if (sheet.holes.empty()) {
    throw UserError(Cause::bad_input, path +
                                          ": there is no hole (a constructed sheet has holes whose "
                                          "diagonals change); name inner panels in \"holes\"");
  }
  const auto mobility = solver::measured_mobility(sheet.sheet, sheet.holes, sheet.folding);
  if (mobility.degrees_of_freedom() == 1) return;
  throw UserError(
      Cause::bad_input,
      fmt::format("{}: its holes leave {} degrees of freedom (the Jacobian has rank {} with {} "
                  "unknowns); take out fewer panels",
                  path, mobility.degrees_of_freedom(), mobility.rank, mobility.unknowns));
}

// The error of an option that is of springs as bodies.
UserError no_bodies(const schema::Design& design, const char* option,
                    std::optional<std::string> value) {
  return UserError(solver::OptionFault{
      option, std::move(value),
      design.is_springs() ? "is of springs as bodies, and the springs have no diameter"
                          : "is of springs, and this sheet's holes have none",
      design.is_springs() ? "give it by " + schema::parameter("diameter_mm") : "take it out"});
}

// Returns the numbers of two diagonals from "A3-A9,A4-A8".
std::pair<int, int> diagonals_named(const solver::Mechanism& mechanism, const std::string& text) {
  const std::size_t comma = text.find(',');
  const int first = diagonal_of_label(mechanism, text.substr(0, comma));
  const int second =
      comma == std::string::npos ? -1 : diagonal_of_label(mechanism, text.substr(comma + 1));
  if (first >= 0 && second >= 0 && first != second) return {first, second};
  throw UserError(
      solver::OptionFault{"never_both", schema::printable(text), "names no two diagonals",
                          fmt::format("write two as in {},{}", schema::diagonal_label(mechanism, 0),
                                      schema::diagonal_label(mechanism, 1))});
}

}  // namespace

UserError study_error(const solver::Obstacle& obstacle, const std::string& sheet,
                      const std::string& consequence, const std::string& advice) {
  if (const auto* const fault = std::get_if<solver::OptionFault>(&obstacle)) {
    return UserError(*fault);
  }
  const NoResult reason = std::get<NoResult>(obstacle);
  if (reason == NoResult::not_in_this_build) {
    return {Cause::failure, schema::missing_text("SUNDIALS")};
  }
  const Reason* const row = std::ranges::find(kReasons, reason, &Reason::reason);
  assert(row != std::end(kReasons));
  return {row->cause, fmt::format("{}: {}, so {}; {}", sheet, row->why, consequence,
                                  advice.empty() ? row->advice : advice)};
}

std::vector<std::pair<int, int>> diagonals_of_one_hole(const solver::Mechanism& mechanism) {
  std::vector<std::pair<int, int>> pairs;
  for (int d = 0; d + 1 < mechanism.diagonal_count(); d += 2) pairs.emplace_back(d, d + 1);
  return pairs;
}

std::optional<solver::SpringBodies> spring_bodies(const schema::Design& design,
                                                  std::optional<double> end_mm) {
  if (!design.diameter_mm || !design.is_springs()) return {};
  return design.spring_bodies(end_mm);
}

solver::ContactOptions contact_options(const schema::Design& design, std::optional<double> trim_mm,
                                       std::optional<double> end_mm) {
  auto bodies = spring_bodies(design, end_mm);
  if (!bodies && end_mm) throw no_bodies(design, "end_mm", schema::shown_number(*end_mm));
  return {trim_mm, design.from_deg, std::move(bodies)};
}

solver::SpringFaces faces_of_springs(const solver::Sheet& sheet, const schema::Design& design,
                                     std::optional<double> end_mm) {
  const auto bodies = spring_bodies(design, end_mm);
  if (!bodies) throw no_bodies(design, "offset_ends", {});
  return value_or_throw(
      solver::spring_faces(sheet, *bodies, solver::angle_of_use(sheet, design.from_deg)),
      sheet.name(), "its springs are not placed");
}

solver::Actuators actuators_on(const solver::Sheet& sheet, const schema::Design& design,
                               std::optional<double> from_deg) {
  solver::Actuators actuators = design.actuators(sheet.base());
  const double used_deg = from_deg.value_or(sheet.deploys_from_deg());
  if (!design.is_springs() || used_deg <= 0) return actuators;
  auto touching = solver::touching_springs(sheet, design.spring_bodies(), used_deg);
  actuators.never_both = touching ? *std::move(touching) : diagonals_of_one_hole(sheet.mechanism());
  return actuators;
}

solver::ContactStudy contact_of(const solver::Sheet& sheet, const solver::ContactOptions& options) {
  return value_or_throw(solver::contact(sheet, options), sheet.name(),
                        "it is not known where panels meet");
}

std::optional<solver::ContactStudy> known_contact(const solver::Sheet& sheet,
                                                  solver::ContactOptions options) {
  auto study = solver::contact(sheet, options);
  if (study.fault()) {
    options.trim_mm = 0;
    study = solver::contact(sheet, options);
  }
  return study ? std::optional(*std::move(study)) : std::nullopt;
}

void need_energy(const solver::Sheet& sheet, const solver::Fill& fill,
                 const std::string& consequence) {
  if (sheet.way() == nullptr) return;  // other reasons are said of a lost path
  const std::vector<double> energy_n_mm = solver::actuate(sheet, {fill, {}}).energy_n_mm;
  if (std::ranges::any_of(energy_n_mm, [](double n_mm) { return n_mm > 0; })) return;
  throw UserError(Cause::bad_request,
                  fmt::format("{}: the filling of its holes stores no energy, so {}; give springs "
                              "or rubber plates by {}",
                              sheet.name(), consequence, schema::parameter("fill")));
}

solver::Actuation actuated(const solver::Sheet& sheet, const schema::Design& design) {
  if (design.from_deg) {
    if (const auto fault = solver::beyond_d(sheet, *design.from_deg)) throw UserError(*fault);
  }
  return solver::actuate(sheet, actuators_on(sheet, design, design.from_deg), design.from_deg);
}

std::optional<solver::RubberStudy> rubber_of(const solver::Sheet& sheet,
                                             const solver::Actuation& actuation) {
  const auto* const plates = std::get_if<solver::RubberPlates>(&actuation.actuators.fill);
  if (!plates) return std::nullopt;
  return value_or_throw(solver::study_rubber(sheet, {*plates, actuation.from_deg}), sheet.name(),
                        "its plates cannot be studied");
}

solver::CutOutChoice chosen_cut_outs(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                                     std::optional<double> from_deg) {
  solver::CutOutOptions options;
  options.plates = plates;
  options.from_deg = from_deg.value_or(sheet.deploys_from_deg());
  return value_or_throw(solver::choose_cut_outs(sheet, options), sheet.name(),
                        "its cut-outs cannot be chosen");
}

solver::SpringChoice chosen_springs(const solver::Sheet& sheet, const schema::Design& design,
                                    const SpringChoiceInput& input) {
  solver::SpringChoiceOptions options = input.options;
  options.from_deg = design.from_deg;
  options.pull_only |= design.pull_only.value_or(false);
  options.one_a_hole |= design.springs_on == solver::SpringsOn::one_a_hole;
  options.friction_n_mm_per_mm = hinge_friction_n_mm_per_mm(design, sheet);
  options.to_deg = design.margin_to_deg.value_or(options.to_deg);
  std::ranges::sort(options.rates_n_per_mm);
  if (design.diameter_mm) {
    options.never_both = actuators_on(sheet, design, options.from_deg).never_both;
  }
  for (const std::string& text : input.never_both) {
    options.never_both.push_back(diagonals_named(sheet.mechanism(), text));
  }
  return value_or_throw(solver::choose_springs(sheet, options), sheet.name(),
                        "no springs are chosen");
}

solver::DeploymentStudy deployed(const solver::Sheet& sheet,
                                 const solver::ReleaseOptions& options) {
  return value_or_throw(solver::deploy(sheet, options), sheet.name(), "it cannot be released");
}

std::optional<solver::PinStudy> pins_of(const solver::Sheet& sheet,
                                        const solver::ReleaseOptions& deploying,
                                        const schema::Design& design) {
  if (!design.pin_friction_mm) return {};
  return value_or_throw(
      solver::study_pins(sheet, deploying, *design.pin_friction_mm, bending(design).to_deg),
      sheet.name(), "its pins cannot be loaded");
}

schema::BentSheet bent_sheet(const solver::Sheet& sheet, const solver::ReleaseOptions& deploying,
                             const schema::Design& design, Advice asked) {
  need_energy(sheet, deploying.sheet.fill, "its panels are not bent");
  solver::BentPanels panels = value_or_throw(solver::bend_panels(sheet, deploying, bending(design)),
                                             sheet.name(), "its panels cannot be bent");
  std::optional<solver::PreloadStudy> preload;
  const auto* const springs = std::get_if<solver::Springs>(&deploying.sheet.fill);
  if (springs && springs->preload.is_any()) {
    preload = value_or_throw(solver::study_preload(sheet, deploying, panels), sheet.name(),
                             "its preload cannot be studied");
  }
  const double wanted = design.static_margin.value_or(solver::kWantedMargin);
  auto advice = asked == Advice::with ? advise(sheet, deploying, panels, wanted)
                                      : solver::BentAdvice{{}, wanted, {}};
  if (!springs) advice.useful_stiffness_n_per_mm.reset();
  solver::BucklingStudy buckling = solver::find_buckling(sheet, deploying.sheet, panels);
  return {design.material.value_or(schema::Material{}), std::move(panels), advice,
          std::move(buckling), preload};
}

ReleasedSheet released_sheet(const solver::Sheet& sheet, const solver::ReleaseOptions& options,
                             const schema::Design& design, bool bends) {
  ReleasedSheet found{deployed(sheet, options), {}, {}};
  if (bends) found.bent = bent_sheet(sheet, options, design);
  found.pins = pins_of(sheet, options, design);
  return found;
}

solver::ConstructStudy constructed(const schema::Pattern& base, const std::string& path, bool rim,
                                   const solver::ConstructOptions& options) {
  check_freedom(base, path);
  const solver::CreasePattern& sheet = base.base.sheet;
  auto family = solver::ParallelFamily::of(
      base.base, rim ? solver::all_vertices(sheet) : solver::interior_vertices(sheet));
  if (const auto* none = std::get_if<solver::NoParallelFamily>(&family)) {
    throw UserError(Cause::bad_input,
                    path + ": " + none->why(sheet) +
                        ", so sheets of it are not constructed; search for them: misalign search");
  }
  return value_or_throw(
      solver::construct(base.base, std::get<solver::ParallelFamily>(family), options), path,
      "it is not constructed");
}

}  // namespace misalign::search
