#include "schema/exchange/backlash_json.hpp"

#include <algorithm>
#include <cassert>

#include "schema/files/json_values.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::schema {
namespace {

Json quantiles_json(const std::vector<double>& values, const char* name) {
  if (values.empty()) return Json::array();
  return json_list(solver::kShownShares, [&](double share) {
    return Json{{"share", share}, {name, solver::quantile(values, share)}};
  });
}

Json one_way_json(const solver::Backlash& backlash, double up_to_deg) {
  const ShareOfTrials share = one_way_share(backlash, up_to_deg);
  return {{"to_deg", up_to_deg},
          {"trials", backlash.one_way_to(up_to_deg)},
          {"share", share.share},
          {"share_low", share.low},
          {"share_high", share.high}};
}

Json ends_json(const solver::Backlash& backlash) {
  Json faults = Json::object();
  for (const solver::BacklashTrial& trial : backlash.trials) {
    if (!trial.is_known || trial.fault == solver::Fault::none) continue;
    auto& count = faults[solver::fault_name(trial.fault)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return faults;
}

}  // namespace

ShareOfTrials one_way_share(const solver::Backlash& backlash, double up_to_deg) {
  return share_of(backlash.one_way_to(up_to_deg), backlash.undecided(), backlash.trials.size());
}

Json backlash_json(const solver::Backlash& backlash, std::optional<double> threshold_deg) {
  const std::vector<double> left = backlash.left_over();
  assert(!left.empty() && "a study has trials");
  Json ends = Json::object();
  for (const solver::BacklashTrial::BranchEnd end :
       {solver::BacklashTrial::BranchEnd::flat, solver::BacklashTrial::BranchEnd::turns,
        solver::BacklashTrial::BranchEnd::other_branch,
        solver::BacklashTrial::BranchEnd::not_known}) {
    ends[solver::name_of(end)] =
        std::count_if(backlash.trials.begin(), backlash.trials.end(),
                      [&](const solver::BacklashTrial& trial) { return trial.lost == end; });
  }
  Json largest = nullptr;
  if (backlash.largest_mm > 0) {
    largest = {{"backlash_mm", backlash.largest_mm},
               {"wanted_share", solver::kWantedShare},
               {"trials", backlash.with_largest}};
    largest["is_most"] = backlash.largest_mm >= backlash.most_mm;
  }
  Json json = {{"backlash_mm", backlash.backlash_mm},
               {"trials", backlash.trials.size()},
               {"undecided", backlash.undecided()},
               {"from_deg", backlash.from_deg},
               {"deploys_from_deg", backlash.own_deg},
               {"one_way", one_way_json(backlash, backlash.to_deg)},
               {"largest", largest},
               {"faults", ends_json(backlash)},
               {"branch_ends", ends},
               {"lost", quantiles_json(backlash.lost_deg(), "lost_deg")},
               {"one_way_from", quantiles_json(backlash.one_way_from_deg(), "from_deg")},
               {"one_way_up_to", quantiles_json(backlash.one_way_to_deg(), "to_deg")},
               {"left_over_backlashes",
                {{"median", solver::quantile(left, 0.5)}, {"largest", left.back()}}}};
  if (const std::vector<double> stops_deg = backlash.stops_deg(); !stops_deg.empty()) {
    json["stops"] = {{"stopped", stops_deg.size()},
                     {"quantiles", quantiles_json(stops_deg, "stops_at_deg")}};
  }
  if (threshold_deg && *threshold_deg > backlash.from_deg) {
    json["one_way_to_threshold"] = one_way_json(backlash, *threshold_deg);
  }
  return json;
}

}  // namespace misalign::schema
