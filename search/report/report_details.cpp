#include "search/report/report_details.hpp"

#include <algorithm>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/contact_json.hpp"
#include "schema/exchange/target_view.hpp"
#include "schema/files/json_values.hpp"
#include "schema/report/report.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/shaped.hpp"
#include "search/sheets/studies.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

// Names a result's sheet: "draw 7 of the campaign 1a2b3c4d", "the pattern table1".
std::string owner(const schema::StressResult& result) {
  if (result.whose.contains("pattern")) {
    return "the pattern " + result.whose["pattern"].get<std::string>();
  }
  return "draw " + result.whose["draw"].dump() + " of the campaign " +
         result.whose["campaign"].get<std::string>();
}

UserError of_another(const schema::StressResult& result, const std::string& shown) {
  return UserError(schema::Cause::bad_input, result.path + ": is a result for " + owner(result) +
                                                 ", but the report is on " + shown +
                                                 "; give a result of `misalign stress` for that");
}

}  // namespace

ReportDetails::ReportDetails(FoldingModel& model, const DetailOptions& options,
                             const schema::Target* target)
    : model_(model), with_contact_(options.contact) {
  if (target) {
    measure_ = model.measure(target->shape, shape_deg(*target, model.design().rest_deg));
  }
  for (const std::string& path : options.stress_files) {
    stress_.push_back(schema::read_stress_result(path));
  }
}

std::vector<std::uint64_t> ReportDetails::draws_with_stress(
    const schema::Campaign& campaign) const {
  const std::string identity = schema::identity(campaign);
  std::vector<std::uint64_t> draws;
  for (const schema::StressResult& result : stress_) {
    if (result.whose.value("campaign", "") != identity) {
      throw of_another(result, "the campaign " + identity);
    }
    const auto draw = result.whose["draw"].get<std::uint64_t>();
    if (std::find(draws.begin(), draws.end(), draw) != draws.end()) {
      throw UserError(schema::Cause::bad_request,
                      result.path + ": is a result for draw " + std::to_string(draw) +
                          ", like another --stress; give one of the two");
    }
    draws.push_back(draw);
  }
  return draws;
}

void ReportDetails::check_stress(const std::string& path, const std::string& fingerprint) const {
  if (stress_.size() > 1) {
    throw UserError(solver::OptionFault{
        "stress",
        {},
        "is given " + std::to_string(stress_.size()) + " times, but " + path + " holds one sheet",
        "give it once"});
  }
  for (const schema::StressResult& result : stress_) {
    if (result.whose.value("sheet", "") != fingerprint) {
      throw of_another(result, "the sheet in " + path);
    }
  }
}

Json ReportDetails::of_draw(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const {
  Json json = detail(sheet, draw, accepted);
  for (const schema::StressResult& result : stress_) {
    if (result.whose["draw"] == draw) {
      json["stress"] = schema::stress_shown_json(result, model_.base());
    }
  }
  return json;
}

Json ReportDetails::of_pattern(const solver::Sheet& sheet, const std::string& name) const {
  Json json = detail(sheet, 0, false);
  json["draw"] = name;  // the page's name for it
  json["accepted"] = nullptr;
  if (!stress_.empty()) json["stress"] = schema::stress_shown_json(stress_[0], model_.base());
  return json;
}

Json ReportDetails::detail(const solver::Sheet& sheet, std::uint64_t draw, bool accepted) const {
  auto from_deg = from_of(sheet);
  if (from_deg && !sheet.row_at(*from_deg)) from_deg.reset();
  const solver::Actuators actuators = actuators_on(sheet, model_.design(), from_deg);
  Json json = schema::detail_json({model_.base(), sheet}, draw, accepted,
                                  solver::actuate(sheet, actuators, from_deg));
  json["from_deg"] = schema::or_null(from_of(sheet));
  json["let_go"] = deployment(sheet);
  if (with_contact_) json["contact"] = contact(sheet);
  if (measure_) json["target"] = schema::target_shown_json(sheet, *measure_);
  return json;
}

// Returns the sheet's motion after release; null if it cannot be released.
Json ReportDetails::deployment(const solver::Sheet& sheet) const {
  solver::ReleaseOptions options = deploy_options(model_.design(), sheet);
  options.from_deg = from_of(sheet);
  const auto study = solver::deploy(sheet, options);
  return study ? schema::page_deployment_json(*study) : Json();
}

// Returns the angle of use, or null for the sheet's D if the angle lies beyond that.
std::optional<double> ReportDetails::from_of(const solver::Sheet& sheet) const {
  const auto from_deg = model_.design().from_deg;
  return from_deg && !solver::beyond_d(sheet, *from_deg) ? from_deg : std::nullopt;
}

// Returns the contact of its panels, with corners trimmed as usual, or untrimmed if no edge would
// remain; null if the path is lost.
Json ReportDetails::contact(const solver::Sheet& sheet) const {
  const auto study = known_contact(sheet, {{}, from_of(sheet)});
  if (!study) return nullptr;
  Json json = schema::contact_study_json(model_.base(), sheet.panels(), *study);
  json.erase("clearance");
  return json;
}

}  // namespace misalign::search
