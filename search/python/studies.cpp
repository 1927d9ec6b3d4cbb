// Binds the studies of one sheet, which return a verb's JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include "schema/catalogue/certificate_row.hpp"
#include "schema/exchange/tolerance_json.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/pattern/design_json.hpp"
#include "schema/pattern/fill_json.hpp"
#include "search/python/bindings.hpp"
#include "search/python/copies.hpp"
#include "search/python/made.hpp"
#include "search/python/pattern_source.hpp"
#include "search/python/signals.hpp"
#include "search/sheets/bought_springs.hpp"
#include "search/sheets/card_limits.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/tolerance.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;
using namespace py::literals;

// Reads a call's design, with the keys of the block `design`.
schema::Design design_of(const std::string& text) {
  schema::InputFaults faults;
  const schema::Design design = schema::read_design(schema::Json::parse(text), "", faults);
  if (!faults.none()) {
    throw schema::UserError(schema::Cause::bad_request, faults.sentences().front());
  }
  return design;
}

// Returns the JSON of `study` for the sheet with this design.
template <class Study>
std::string json_of_study(const PatternSource& source, const std::string& design,
                          const Study& study) {
  return unlocked([&] {
    Subject subject(source.sheet, design_of(design));
    return study_json(subject, study(subject)).dump();
  });
}

std::string contact(const PatternSource& source, const std::string& design,
                    const std::optional<double>& trim_mm, const std::optional<double>& end_mm,
                    bool offset_ends) {
  if (trim_mm) schema::check_parameter("", "trim_mm", *trim_mm);
  if (end_mm) schema::check_parameter("contact", "end_mm", *end_mm);
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    const schema::Design& with = subject.model.design();
    const auto study = contact_of(subject.sheet, contact_options(with, trim_mm, end_mm));
    std::optional<solver::SpringFaces> faces;
    if (offset_ends) faces = faces_of_springs(subject.sheet, with, end_mm);
    return study_json(subject, study, faces).dump();
  });
}

std::string actuators(const PatternSource& source, const std::string& design) {
  return json_of_study(source, design, [](const Subject& subject) {
    return actuated(subject.sheet, subject.model.design());
  });
}

std::string choose_springs(const PatternSource& source, const std::string& design,
                           double most_rate_n_per_mm, const std::vector<double>& rates_n_per_mm,
                           double free_within, bool pull_only, bool one_a_hole,
                           const std::vector<std::string>& never_both,
                           std::optional<int> most_springs, std::optional<double> fewest_margin,
                           std::optional<double> equal_lengths_share) {
  const auto check = [](const char* name, double value) {
    schema::check_parameter("actuators", name, value);
  };
  check("most_rate_n_per_mm", most_rate_n_per_mm);
  for (const double rate : rates_n_per_mm) check("rates_n_per_mm", rate);
  check("free_within", free_within);
  if (most_springs) check("most_springs", *most_springs);
  if (fewest_margin) check("fewest_margin", *fewest_margin);
  if (equal_lengths_share) check("equal_lengths_share", *equal_lengths_share);
  return json_of_study(source, design, [&](const Subject& subject) {
    SpringChoiceInput input{{}, never_both};
    input.options.most_rate_n_per_mm = most_rate_n_per_mm;
    input.options.rates_n_per_mm = rates_n_per_mm;
    input.options.free_within = free_within;
    input.options.pull_only = pull_only;
    input.options.one_a_hole = one_a_hole;
    input.options.most_springs = most_springs;
    input.options.fewest_margin = fewest_margin;
    input.options.equal_lengths_share = equal_lengths_share;
    return chosen_springs(subject.sheet, subject.model.design(), input);
  });
}

std::string buy_springs(const PatternSource& source, const std::string& design,
                        const std::optional<std::string>& springs,
                        const std::optional<double>& static_margin, const std::string& least,
                        bool push, double link_step_mm, double least_link_mm) {
  schema::check_parameter("actuators", "link_step_mm", link_step_mm);
  schema::check_parameter("actuators", "least_link_mm", least_link_mm);
  if (static_margin) {
    schema::check_design("static_margin", "wanted.static_margin", *static_margin);
  }
  const std::optional<solver::StockGoal> goal = goal_of_purchase(least);
  if (!goal) {
    throw schema::UserError(solver::OptionFault{"least", schema::printable(least),
                                                "is no objective of springs to buy",
                                                "choose types or price"});
  }
  return json_of_study(source, design, [&](const Subject& subject) {
    BuyInput input;
    if (springs) input.table = schema::read_spring_table(*springs);
    input.links = {.step_mm = link_step_mm, .least_mm = least_link_mm, .largest_force_n = {}};
    input.pushes = push;
    input.goal = *goal;
    schema::Design with = subject.model.design();
    if (static_margin) with.static_margin = static_margin;
    return bought_springs(subject.sheet, with, input);
  });
}

std::string deploy(const PatternSource& source, const std::string& design,
                   const std::optional<bool>& bends) {
  return json_of_study(source, design, [&](const Subject& subject) {
    const schema::Design& whole = subject.model.design();
    return released_sheet(subject.sheet, deploy_options(whole, subject.sheet), whole,
                          bends.value_or(panels_bend(whole, subject.sheet)));
  });
}

std::string optimise(const PatternSource& source, const std::string& design,
                     const std::string& goal, std::optional<double> amplitude_mm,
                     std::optional<double> deploys_from_deg, bool ternary,
                     std::optional<double> grid_mm, bool rim, bool within_family, bool keep_card,
                     const std::vector<std::string>& subject_to,
                     const std::vector<double>& stiffness_within,
                     const std::vector<double>& preload_within, std::optional<double> rest_deg,
                     std::optional<double> miscut_mm, std::int64_t trials) {
  const auto check = [](const char* name, const std::optional<double>& value) {
    if (value) schema::check_parameter("optimise", name, *value);
  };
  check("amplitude_mm", amplitude_mm);
  check("deploys_from_deg", deploys_from_deg);
  check("grid_mm", grid_mm);
  check("rest_deg", rest_deg);
  check("miscut_mm", miscut_mm);
  const auto copies = checked_count<std::uint64_t>("optimise", "trials", trials);
  return json_of_study(source, design, [&](Subject& subject) {
    OptimiseInput input;
    input.goal = solver::goal_named(goal);
    if (!input.goal) {
      throw schema::UserError(solver::OptionFault{
          "goal", schema::printable(goal), schema::unknown_word(goal, "goal", solver::goal_names()),
          fmt::format("choose one of {}", fmt::join(solver::goal_names(), ", "))});
    }
    input.bounds = schema::bounds_of(subject_to);
    input.ternary = ternary;
    input.grid_mm = grid_mm;
    input.amplitude_mm = amplitude_mm;
    input.deploys_from_deg = deploys_from_deg;
    input.with_rim = rim;
    input.within_family = within_family;
    input.stiffness_n_per_mm = stiffness_within;
    input.preload_n = preload_within;
    input.rest_deg = rest_deg;
    input.miscut_mm = miscut_mm;
    input.trials = copies;
    input.watch = watch_signals;
    if (keep_card) {
      search::keep_card(subject, {.trials = copies, .advice = Advice::none}, input.bounds);
    }
    return optimised(subject, input);
  });
}

std::string card(const PatternSource& source, const std::string& design, std::int64_t trials,
                 std::int64_t jobs) {
  const CardOptions options{checked_count<std::uint64_t>("card", "trials", trials),
                            checked_count<int>("", "jobs", jobs)};
  return json_of_study(source, design,
                       [&](const Subject& subject) { return card_of(subject, options).card; });
}

std::string certify(const PatternSource& source, const std::string& design, bool contact,
                    const std::optional<std::string>& name) {
  const auto criterion = name ? solver::certified_by(*name) : std::nullopt;
  if (name && !criterion) {
    throw schema::UserError(solver::OptionFault{"criterion", schema::printable(*name),
                                                "is no criterion",
                                                "write \"diagonals\" or \"energy\""});
  }
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    const solver::Model model = model_of(subject.chosen.base, subject.chosen.sampling);
    const double d_deg = subject.sheet.deploys_from_deg();
    const double from_deg = subject.model.design().from_deg.value_or(d_deg);
    if (!(from_deg > 0))
      throw schema::UserError(solver::beyond_d_fault(subject.sheet.name(), 0, 0));
    RowCertifier certifier(subject.chosen.base, model,
                           claims_of(subject.chosen.base, subject.chosen.sampling,
                                     subject.model.design(), criterion, contact));
    return schema::certificate_json(certifier.certify(0, subject.chosen.shifts_mm, from_deg))
        .dump();
  });
}

std::string tolerance(const PatternSource& source, const std::string& design_text,
                      std::int64_t trials, std::int64_t jobs) {
  ToleranceOptions options = copies_of(trials, jobs);
  return unlocked([&] {
    const schema::Design design = design_of(design_text).merged_over(source.sheet.design);
    if (!design.miscut_mm) {
      throw schema::UserError(
          schema::Cause::bad_request,
          "amplitude_mm: is not given, and the design has no miscut_mm; try 0.05");
    }
    options.amplitude_mm = *design.miscut_mm;
    schema::check_fill(design, source.sheet.base.base);
    options.filled = filled_by(design, source.sheet.base.base);
    check_miscut(options.amplitude_mm, source.pattern(), source.sheet.shifts_mm,
                 source.sheet.pattern);
    return schema::tolerance_json(study_sheet(source.sheet, design.from_deg, options)).dump();
  });
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("contact", made(&contact), "sheet"_a, "design"_a, "trim_mm"_a, "end_mm"_a,
             "offset_ends"_a);
  module.def("actuators", made(&actuators), "sheet"_a, "design"_a);
  module.def("deploy", made(&deploy), "sheet"_a, "design"_a, "bends"_a);
  module.def("optimise", made(&optimise), "sheet"_a, "design"_a, py::kw_only(), "goal"_a,
             "amplitude_mm"_a, "deploys_from_deg"_a, "ternary"_a, "grid_mm"_a, "rim"_a,
             "within_family"_a, "keep_card"_a, "subject_to"_a, "stiffness_within"_a,
             "preload_within"_a, "rest_deg"_a, "miscut_mm"_a, "trials"_a);
  module.def("card", made(&card), "sheet"_a, "design"_a, "trials"_a, "jobs"_a);
  module.def("certify", made(&certify), "sheet"_a, "design"_a, "contact"_a, "criterion"_a);
  module.def("choose_springs", made(&choose_springs), "sheet"_a, "design"_a, py::kw_only(),
             "most_rate_n_per_mm"_a, "rates_n_per_mm"_a, "free_within"_a, "pull_only"_a,
             "one_a_hole"_a, "never_both"_a, "most_springs"_a, "fewest_margin"_a,
             "equal_lengths_share"_a);
  module.def("buy_springs", made(&buy_springs), "sheet"_a, "design"_a, py::kw_only(), "springs"_a,
             "static_margin"_a, "least"_a, "push"_a, "link_step_mm"_a, "least_link_mm"_a);
  module.def("check_design", &schema::check_design, "name"_a, "design_key"_a, "value"_a);
  module.def("tolerance", made(&tolerance), "sheet"_a, "design"_a, "trials"_a, "jobs"_a);
}

}  // namespace misalign::search::python
