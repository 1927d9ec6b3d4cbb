#include "schema/catalogue/status_json.hpp"

#include "schema/campaign/share_interval.hpp"
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

Json share_json(std::uint64_t some, std::uint64_t all) {
  return all > 0 ? Json(static_cast<double>(some) / static_cast<double>(all)) : Json();
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

Json ladder_json(const CatalogueState& state) {
  Json levels = Json::array();
  for (const LadderLevel& level : state.ladder->levels) {
    const SplitRate& rate = level.rate;
    levels.push_back({{"level", levels.size()},
                      {"deploys_from_deg", levels.empty() ? Json() : Json(level.deploys_from_deg)},
                      {"rate", rate.mean},
                      {"rate_low", rate.interval ? Json(rate.interval->low) : Json()},
                      {"rate_high", rate.interval ? Json(rate.interval->high) : Json()},
                      {"relative_error", or_null(rate.relative_half_width())},
                      {"populations_here", rate.reached},
                      {"largest_part", rate.largest_part},
                      {"reach_next", share_json(level.survivors, level.particles)},
                      {"ancestors", level.ancestors},
                      {"tried", level.tried},
                      {"taken", level.taken},
                      {"undecided", level.undecided},
                      {"met", level.met},
                      {"core_s", level.seconds}});
  }
  const SplitRate* const rate = state.ladder->rate();
  return {{"populations", state.ladder->populations},
          {"missing", state.missing_populations()},
          {"converged", rate && has_converged(*rate)},
          {"levels", levels}};
}

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
