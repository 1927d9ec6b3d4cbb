#include "search/report/report_details.hpp"

#include <algorithm>

#include "schema/exchange/contact_json.hpp"
#include "schema/report/report.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::UserError;

// "draw 7 of the campaign 1a2b3c4d", "the pattern table1".
std::string owner(const schema::StressResult& result) {
  if (result.whose.contains("pattern")) {
    return "the pattern " + result.whose["pattern"].get<std::string>();
  }
  return "draw " + result.whose["draw"].dump() + " of the campaign " +
         result.whose["campaign"].get<std::string>();
}

UserError of_another(const schema::StressResult& result, const std::string& shown) {
  return UserError(schema::Cause::bad_input, result.path + ": is of " + owner(result) +
                                                 ", and what is reported is " + shown +
                                                 "; name a result of `misalign stress` on that");
}

}  // namespace

ReportDetails::ReportDetails(const SheetFolder& folder, const DetailOptions& options)
    : folder_(folder), deployer_(folder.base(), folder.sampling(), folder.actuators(), {}) {
  for (const std::string& path : options.stress_files) {
    stress_.push_back(schema::read_stress_result(path));
  }
  if (options.contact) contact_.emplace(folder.base(), folder.sampling());
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
                      result.path + ": is of draw " + std::to_string(draw) +
                          ", as another --stress is; name one of the two");
    }
    draws.push_back(draw);
  }
  return draws;
}

void ReportDetails::check_stress(const std::string& path, const std::string& fingerprint) const {
  if (stress_.size() > 1) {
    throw UserError(schema::Cause::bad_request,
                    "--stress: is given " + std::to_string(stress_.size()) + " times, and " + path +
                        " is one sheet; give it once");
  }
  for (const schema::StressResult& result : stress_) {
    if (result.whose.value("sheet", "") != fingerprint) {
      throw of_another(result, "the sheet in " + path);
    }
  }
}

Json ReportDetails::of_draw(const FoldedSheet& folded, std::uint64_t draw, bool accepted) {
  Json json = detail(folded, draw, accepted);
  for (const schema::StressResult& result : stress_) {
    if (result.whose["draw"] == draw) {
      json["stress"] = schema::stress_shown_json(result, folder_.base());
    }
  }
  return json;
}

Json ReportDetails::of_pattern(const FoldedSheet& folded, const std::string& name) {
  Json json = detail(folded, 0, false);
  json["draw"] = name;  // by which the page knows it
  json["accepted"] = nullptr;
  if (!stress_.empty()) json["stress"] = schema::stress_shown_json(stress_[0], folder_.base());
  return json;
}

Json ReportDetails::detail(const FoldedSheet& folded, std::uint64_t draw, bool accepted) {
  Json json = schema::detail_json(folder_.view(folded), draw, accepted, folded.path,
                                  folded.actuation, folded.metrics);
  json["let_go"] = deployment(folded);
  if (contact_) json["contact"] = contact(folded);
  return json;
}

// Its deployment; null where it cannot be released.
Json ReportDetails::deployment(const FoldedSheet& folded) {
  const double deploys_from_deg =
      folded.path.history.verdict.deploys_from_sample * folder_.sampling().sample_deg;
  const auto study = deployer_.study_if_possible(folded.shifts_mm, deploys_from_deg);
  return study ? schema::page_deployment_json(*study) : Json();
}

// Where its panels meet, its corners trimmed by the usual or, where that leaves nothing of an edge,
// by nothing; null where the path is lost.
Json ReportDetails::contact(const FoldedSheet& folded) {
  for (const std::optional<double> trim_mm : {std::optional<double>(), std::optional<double>(0)}) {
    try {
      Json json =
          schema::contact_study_json(folder_.base(), contact_->panels(),
                                     contact_->study(folded.shifts_mm, trim_mm, "the sheet"));
      json.erase("clearance");
      return json;
    } catch (const UserError& error) {
      if (error.cause() != schema::Cause::bad_request) return nullptr;
    }
  }
  return nullptr;
}

}  // namespace misalign::search
