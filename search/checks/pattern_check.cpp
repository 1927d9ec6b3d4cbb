#include "search/checks/pattern_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/catalogue/metric_table.hpp"
#include "schema/exchange/folding_json.hpp"
#include "schema/files/features.hpp"
#include "search/sheets/chosen_sheet.hpp"
#include "solver/pattern/parallel_family.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::shown_number;

// Returns verdict and metrics of a folding, with elongations: {"verdict", "metrics"}.
Json folded_values(const schema::FoldingView& view) {
  Json values = {{"verdict", schema::verdict_json(view)}, {"metrics", nullptr}};
  if (const auto metrics = view.sheet.measure(view.history)) {
    values["metrics"] = schema::metrics_json(*metrics);
    values["metrics"]["elongation"] = Json(metrics->elongation).dump();
  }
  return values;
}

// Returns the same of an exported candidate, as far as its file has it.
Json exported_values(const Json& exported) {
  Json values = Json::object();
  for (const char* part : {"verdict", "metrics"}) {
    if (exported.contains(part)) values[part] = exported[part];
  }
  const Json diagonals = exported.value("diagonals", Json());
  if (!values.contains("metrics") || !values["metrics"].is_object() || !diagonals.is_array()) {
    return values;
  }
  Json elongation = Json::array();
  for (const Json& diagonal : diagonals) {
    if (!diagonal.is_object() || !diagonal.contains("elongation")) return values;
    elongation.push_back(diagonal["elongation"]);
  }
  values["metrics"]["elongation"] = elongation.dump();
  return values;
}

// Returns whether a bump ends D; up to version 1.0.0 it was no bump_deg.
bool ends_in_bump(const Json& computed) {
  return computed["verdict"]["first_fault"] == solver::fault_name(solver::Fault::bump);
}

// Compares the file's values with the computed ones; a missing value is no finding.
void compare(const std::string& where, const Json& values, const Json& computed,
             const ColumnTolerances& tolerances, std::vector<schema::Finding>& findings) {
  for (const auto& [part, theirs] : values.items()) {
    const Json& ours = computed.at(part);
    if (!theirs.is_object() || !ours.is_object()) {
      if (theirs != ours) findings.push_back(schema::differs(where, part, theirs, ours));
      continue;
    }
    for (const auto& [key, value] : ours.items()) {
      // A pattern has no threshold, up to which a campaign's candidates have their margins.
      const schema::MetricEntry* const metric = schema::find_metric(key);
      if (!theirs.contains(key) || (metric && metric->needs_a_campaign)) continue;
      const Json& stored = theirs.at(key);
      if (key == "bump_deg" && stored.is_null() && ends_in_bump(computed)) continue;
      if (!tolerances.agree(key, stored, value)) {
        findings.push_back(schema::differs(where, part + "." + key, stored, value));
      }
    }
  }
}

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::Index rows = std::min(a.rows(), b.rows());
  return rows == 0 ? 0 : (a.topRows(rows) - b.topRows(rows)).cwiseAbs().maxCoeff();
}

// Returns lengths by the closed forms of the holes, a row per station, for a sheet with its base's
// fold angles.
Eigen::MatrixXd lengths_by_formula_mm(const solver::Sheet& sheet) {
  const auto family =
      solver::ParallelFamily::of(sheet.base(), solver::all_vertices(sheet.base().sheet));
  const auto motions = std::get<solver::ParallelFamily>(family).motions(sheet.shifts_mm());
  const std::vector<solver::Station>& stations = sheet.history().stations;
  Eigen::MatrixXd lengths_mm(std::ssize(stations), 2 * std::ssize(motions));
  for (Eigen::Index row = 0; row < lengths_mm.rows(); ++row) {
    const auto& pilot = stations[static_cast<std::size_t>(row)].pilot;
    for (Eigen::Index d = 0; d < lengths_mm.cols(); ++d) {
      lengths_mm(row, d) =
          motions[static_cast<std::size_t>(d / 2)].length_mm(static_cast<int>(d % 2), pilot);
    }
  }
  return lengths_mm;
}

}  // namespace

PatternVerification verify_pattern(const std::string& path) {
  const ChosenSheet chosen = sheet_of_pattern_file(path);
  const FoldedCheck check(chosen.base, chosen.sampling);
  const solver::Sheet sheet = check.sheet(chosen.shifts_mm);
  const solver::FoldingHistory& history = sheet.history();
  const Json computed = folded_values({chosen.base, sheet});
  PatternVerification verification;
  verification.pattern = chosen.pattern;
  verification.verdict = computed["verdict"];
  ShapeReport& report = verification.report;
  verification.is_on_base = sheet.model().is_overconstrained();
  if (verification.is_on_base) {
    verification.apart_mm = largest_difference(history.length_mm, lengths_by_formula_mm(sheet));
    const double limit_mm =
        solver::shape_tolerance(sheet.panels()) * sheet.mechanism().panel_width_mm;
    if (!(verification.apart_mm <= limit_mm)) {
      report.findings.push_back(
          schema::differs("closed forms", "length difference (mm)", 0, verification.apart_mm));
    }
  } else {
    const auto pivoted = solver::record_with_pivoting(sheet.model(), sheet.vertices_mm());
    verification.apart_mm = largest_difference(history.length_mm, pivoted.length_mm);
    compare("pivoting", folded_values({chosen.base, sheet, pivoted}), computed, check.tolerances(),
            report.findings);
  }
  if (!chosen.exported.is_null()) {
    const Json claims = exported_values(chosen.exported);
    verification.has_claims = !claims.empty();
    compare("the file", claims, computed, check.tolerances(), report.findings);
  }
  const Eigen::Index up_to_d = history.verdict.deploys_from_sample;
  const Eigen::Index samples = std::ranges::count_if(
      history.stations, [](const solver::Station& station) { return station.sample > 0; });
  verification.shapes =
      up_to_d > 0 ? up_to_d
                  : std::min(solver::rows_folded_well(check.mechanism(), history), samples);
  check.check_shapes(chosen.pattern, sheet, verification.shapes, report);
  return verification;
}

std::string pattern_verification_text(const PatternVerification& v) {
  const ShapeReport& report = v.report;
  std::string text = findings_text(report.findings);
  text += "pattern      " + v.pattern + ", deploys from " +
          shown_number(v.verdict["deploys_from_deg"].get<double>()) +
          " deg; first fault: " + v.verdict["first_fault"].get<std::string>() + "\n";
  text += v.is_on_base
              ? "solvers      base's fold angles and closed forms of the holes: lengths differ by "
              : "solvers      fixed order of elimination and pivoting: lengths differ by ";
  text += fmt::format("{:.1e}", v.apart_mm) + " mm\n";
  if (v.has_claims) text += "compared     with the values in the file\n";
  text += "errors       " + worst_text(report.shape, report.diagonal_mm) + ", in " +
          std::to_string(v.shapes) + " folded shapes\n";
  text += report.first_contact_deg
              ? "crossings    panels first cross at " + shown_number(*report.first_contact_deg) +
                    " deg (" + report.contact + ")\n"
              : no_contacts_text();
  text += "any angle    " + report.meet_text + "\n";
  return text + "findings     " + (v.good() ? "none" : std::to_string(report.findings.size())) +
         "\n";
}

Json pattern_verification_json(const PatternVerification& v) {
  const bool crosses = v.report.first_contact_deg.has_value();
  return {{"pattern", v.pattern},
          {"verdict", v.verdict},
          {"good", v.good()},
          {"findings", findings_json(v.report.findings)},
          {"compared_with_file", v.has_claims},
          {"solvers_apart_mm", v.apart_mm},
          {"shapes", v.shapes},
          {"panels_checked", has("FCL")},
          {"first_contact_deg", crosses ? Json(*v.report.first_contact_deg) : Json()},
          {"panels", crosses ? Json(v.report.contact) : Json()},
          {"contact", v.report.meet},
          {"contact_known_until_deg", v.report.met_until_deg},
          {"worst", worst_json(v.report.shape, v.report.diagonal_mm)}};
}

}  // namespace misalign::search
