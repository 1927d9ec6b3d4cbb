#include "schema/catalogue/status_json.hpp"

#include "schema/campaign/share_interval.hpp"
#include "schema/catalogue/ladder_json.hpp"
#include "schema/files/json_values.hpp"

namespace misalign::schema {
namespace {

Json rate_json(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  const auto [low, high] = share_interval(hits, undecided, trials);
  return {{"rate", trials > 0 ? Json(share(hits, trials)) : Json()},
          {"rate_low", low},
          {"rate_high", high},
          {"relative_error", hits > 0 ? Json((high - low) / (2 * share(hits, trials))) : Json()}};
}

Json fault_sample_json(const CatalogueState& state) {
  const WeightedCount all = state.sampled();
  Json json = Json::object();
  for (const auto& [fault, draws] : state.faults) {
    const auto [low, high] = share_interval(draws, all);
    json[fault] = {{"sampled", draws.rows},
                   {"share", share(draws, all)},
                   {"share_low", low},
                   {"share_high", high}};
  }
  return json;
}

}  // namespace

Json status_json(const CatalogueState& state) {
  Json gaps = Json::array();
  for (const DrawRange& gap : state.gaps) gaps.push_back({gap.lo, gap.hi});
  Json json = {{"campaign", state.name},
               {"identity", state.identity},
               {"range", {state.goal.range.lo, state.goal.range.hi}},
               {"goal_end", state.goal_end},
               {"threshold_deg", state.threshold_deg},
               {"goal",
                {{"draws", or_null(state.goal.draws)},
                 {"accepted", or_null(state.goal.accepted)},
                 {"relative_error", or_null(state.goal.relative_error)}}},
               {"complete", state.gaps.empty()},
               {"draws", state.draws},
               {"missing", state.missing()},
               {"draws_in_ledger", state.draws_in_ledger},
               {"accepted", state.accepted},
               {"rejected", state.rejected},
               {"undecided", state.undecided},
               {"acceptance", rate_json(state.accepted, state.undecided, state.draws)},
               {"fault_sample", fault_sample_json(state)},
               {"draws_per_s", state.draws_per_s},
               {"gaps", gaps},
               {"digest", state.digest}};
  if (state.ladder) json["ladder"] = ladder_json(state);
  if (state.ends) {
    json["ends"] = {{"goal", state.ends->goal},
                    {"sheets", state.ends->sheets},
                    {"kept_as_drawn", state.ends->kept_as_drawn},
                    {"best", or_null(state.ends->best)},
                    {"median", or_null(state.ends->median)}};
  }
  return json;
}

Json deploying_json(const DeployingFrom& deploying, const CatalogueState& state) {
  Json json = rate_json(deploying.accepted, state.undecided, state.draws);
  json["deploys_from_deg"] = deploying.at_deg;
  json["accepted"] = deploying.accepted;
  return json;
}

Json page_state_json(const CatalogueState& state) {
  Json json = status_json(state);
  json["without_end"] = state.goal_end == kEndOfDraws;
  if (!state.ladder) return json;
  const SplitRate* const rate = state.ladder->rate();
  json["ladder"].update(
      {{"why_not_converged", rate ? why_not_converged(*rate) : ""},
       {"without_end", state.goal_end / kNumbersOfPopulation >= kEndOfPopulations},
       {"numbers_of_population", kNumbersOfPopulation}});
  return json;
}

}  // namespace misalign::schema
