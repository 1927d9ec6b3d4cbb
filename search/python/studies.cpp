// `_misalign.study`: what a verb says of one sheet, as JSON.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include "schema/catalogue/certificate_row.hpp"
#include "schema/exchange/tolerance_json.hpp"
#include "schema/files/suggestion.hpp"
#include "schema/pattern/design_json.hpp"
#include "search/python/bindings.hpp"
#include "search/python/copies.hpp"
#include "search/python/made.hpp"
#include "search/python/pattern_source.hpp"
#include "search/python/signals.hpp"
#include "search/sheets/card.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/tolerance.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search::python {
namespace {

namespace py = pybind11;

// What was said of the design, by the block's own keys.
schema::Design design_of(const std::string& said) {
  schema::InputFaults faults;
  const schema::Design design = schema::read_design(schema::Json::parse(said), "", faults);
  if (!faults.none()) {
    throw schema::UserError(schema::Cause::bad_request, faults.sentences().front());
  }
  return design;
}

std::string contact(const PatternSource& source, const std::string& design,
                    const std::optional<double>& trim_mm) {
  if (trim_mm) schema::check_parameter("", "trim_mm", *trim_mm);
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    return study_json(subject,
                      contact_of(subject.sheet, {trim_mm, subject.model.design().from_deg}))
        .dump();
  });
}

std::string actuators(const PatternSource& source, const std::string& design) {
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    return study_json(subject, actuated(subject.sheet, subject.model.design())).dump();
  });
}

std::string deploy(const PatternSource& source, const std::string& design,
                   const std::optional<bool>& bends) {
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    const schema::Design& whole = subject.model.design();
    return study_json(subject,
                      released_sheet(subject.sheet, deploy_options(whole, subject.sheet), whole,
                                     bends.value_or(panels_bend(whole, subject.sheet))))
        .dump();
  });
}

std::string optimise(const PatternSource& source, const std::string& design,
                     const std::string& goal, std::optional<double> amplitude_mm,
                     std::optional<double> deploys_from_deg, bool ternary,
                     std::optional<double> grid_mm, bool within_family,
                     const std::vector<std::string>& subject_to,
                     const std::vector<double>& stiffness_within,
                     const std::vector<double>& preload_within, std::optional<double> rest_deg,
                     double miscut_mm, std::int64_t trials) {
  const auto check = [](const char* name, const std::optional<double>& value) {
    if (value) schema::check_parameter("optimise", name, *value);
  };
  check("amplitude_mm", amplitude_mm);
  check("deploys_from_deg", deploys_from_deg);
  check("grid_mm", grid_mm);
  check("rest_deg", rest_deg);
  check("miscut_mm", miscut_mm);
  const auto copies = checked_count<std::uint64_t>("optimise", "trials", trials);
  return unlocked([&] {
    OptimiseInput input;
    input.goal = solver::goal_named(goal);
    if (!input.goal) {
      throw schema::UserError(solver::OptionFault{
          "goal", schema::printable(goal), schema::unknown_word(goal, "goal", solver::goal_names()),
          fmt::format("name one of {}", fmt::join(solver::goal_names(), ", "))});
    }
    input.bounds = schema::bounds_of(subject_to);
    input.ternary = ternary;
    input.grid_mm = grid_mm;
    input.amplitude_mm = amplitude_mm;
    input.deploys_from_deg = deploys_from_deg;
    input.within_family = within_family;
    input.stiffness_n_per_mm = stiffness_within;
    input.preload_n = preload_within;
    input.rest_deg = rest_deg;
    input.miscut_mm = miscut_mm;
    input.trials = copies;
    input.watch = watch_signals;
    Subject subject(source.sheet, design_of(design));
    return study_json(subject, optimised(subject, input)).dump();
  });
}

std::string card(const PatternSource& source, const std::string& design, std::int64_t trials,
                 std::int64_t jobs) {
  const CardOptions options{checked_count<std::uint64_t>("card", "trials", trials),
                            checked_count<int>("", "jobs", jobs)};
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    return study_json(subject, card_of(subject, options).card).dump();
  });
}

std::string certify(const PatternSource& source, const std::string& design, bool contact) {
  return unlocked([&] {
    const Subject subject(source.sheet, design_of(design));
    const solver::Model model = model_of(subject.chosen.base, subject.chosen.sampling);
    const double d_deg = subject.sheet.deploys_from_deg();
    const double from_deg = subject.model.design().from_deg.value_or(d_deg);
    if (!(from_deg > 0))
      throw schema::UserError(solver::beyond_d_fault(subject.sheet.name(), 0, 0));
    RowCertifier certifier(subject.chosen.base, model, contact);
    return schema::certificate_json(certifier.certify(0, subject.chosen.shifts_mm, from_deg))
        .dump();
  });
}

std::string tolerance(const PatternSource& source, const std::string& said, std::int64_t trials,
                      std::int64_t jobs) {
  ToleranceOptions options = copies_of(trials, jobs);
  return unlocked([&] {
    const schema::Design design = design_of(said).instead_of(source.sheet.design);
    if (!design.miscut_mm) {
      throw schema::UserError(
          schema::Cause::bad_request,
          "amplitude_mm: is not said, nor does the design say miscut_mm; try 0.05");
    }
    options.amplitude_mm = *design.miscut_mm;
    check_miscut(options.amplitude_mm, source.pattern(), source.sheet.shifts_mm,
                 source.sheet.pattern);
    return schema::tolerance_json(study_sheet(source.sheet, design.from_deg, options)).dump();
  });
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("contact", made(&contact), py::arg("sheet"), py::arg("design"), py::arg("trim_mm"));
  module.def("actuators", made(&actuators), py::arg("sheet"), py::arg("design"));
  module.def("deploy", made(&deploy), py::arg("sheet"), py::arg("design"), py::arg("bends"));
  module.def("optimise", made(&optimise), py::arg("sheet"), py::arg("design"), py::kw_only(),
             py::arg("goal"), py::arg("amplitude_mm"), py::arg("deploys_from_deg"),
             py::arg("ternary"), py::arg("grid_mm"), py::arg("within_family"),
             py::arg("subject_to"), py::arg("stiffness_within"), py::arg("preload_within"),
             py::arg("rest_deg"), py::arg("miscut_mm"), py::arg("trials"));
  module.def("card", made(&card), py::arg("sheet"), py::arg("design"), py::arg("trials"),
             py::arg("jobs"));
  module.def("certify", made(&certify), py::arg("sheet"), py::arg("design"), py::arg("contact"));
  module.def("check_design", &schema::check_design, py::arg("name"), py::arg("design_key"),
             py::arg("value"));
  module.def("tolerance", made(&tolerance), py::arg("sheet"), py::arg("design"), py::arg("trials"),
             py::arg("jobs"));
}

}  // namespace misalign::search::python
