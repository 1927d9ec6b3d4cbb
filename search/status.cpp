#include "search/status.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "schema/share_interval.hpp"

namespace misalign::search {
namespace {

double share(std::uint64_t hits, std::uint64_t trials) {
  return trials > 0 ? static_cast<double>(hits) / static_cast<double>(trials) : 0;
}

schema::Json rate_json(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  const auto [low, high] = schema::share_interval(hits, undecided, trials);
  return {{"rate", trials > 0 ? schema::Json(share(hits, trials)) : schema::Json()},
          {"rate_low", low},
          {"rate_high", high},
          {"relative_error",
           hits > 0 ? schema::Json((high - low) / (2 * share(hits, trials))) : schema::Json()}};
}

std::string rate_text(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  const auto [low, high] = schema::share_interval(hits, undecided, trials);
  char text[120];
  std::snprintf(text, sizeof text, "%.4g %% (95 %%: %.4g to %.4g)", 100 * share(hits, trials),
                100 * low, 100 * high);
  return text;
}

bool endless(std::uint64_t end) { return end == schema::kEndOfDraws; }

std::uint64_t missing(const schema::CatalogueState& state) {
  std::uint64_t draws = 0;
  for (const schema::DrawRange& gap : state.gaps) draws += gap.size();
  return draws;
}

}  // namespace

std::string status_text(const schema::CatalogueState& state) {
  std::string text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += name + std::string(13 - name.size(), ' ') + value + "\n";
  };
  line("campaign", state.name + " (" + state.identity.substr(0, 8) + ")");
  line("goal", "draws from " + std::to_string(state.goal.range.lo) +
                   (endless(state.goal_end) ? " on, without end"
                                            : " to " + std::to_string(state.goal_end) + ", " +
                                                  std::to_string(missing(state)) + " missing"));
  if (state.goal.accepted) line("", "or " + std::to_string(*state.goal.accepted) + " accepted");
  if (state.goal.relative_error) {
    line("", "or a rate known to " + schema::shown_number(100 * *state.goal.relative_error) + " %");
  }
  line("draws", std::to_string(state.draws));
  line("accepted", std::to_string(state.accepted) + ", " +
                       rate_text(state.accepted, state.undecided, state.draws));
  line("rejected", std::to_string(state.rejected));
  line("undecided",
       std::to_string(state.undecided) +
           (state.undecided > 0 ? ", counted as rejected at the interval's low end, as "
                                  "accepted at its high end"
                                : ""));
  std::string faults;
  std::uint64_t sampled = 0;
  for (const auto& [fault, draws] : state.faults) sampled += draws;
  for (const auto& [fault, draws] : state.faults) {
    char percent[40];
    std::snprintf(percent, sizeof percent, " %.3g %%", 100 * share(draws, sampled));
    faults += (faults.empty() ? "" : ", ") + fault + percent;
  }
  if (sampled > 0) line("faults", faults + " (of a sample of " + std::to_string(sampled) + ")");
  line("draws/s", schema::shown_number(std::round(state.draws_per_s * 10) / 10));
  line("digest", state.digest);
  return text;
}

schema::Json status_json(const schema::CatalogueState& state) {
  const auto or_null = [](const auto& limit) {
    return limit ? schema::Json(*limit) : schema::Json();
  };
  schema::Json gaps = schema::Json::array();
  for (const schema::DrawRange& gap : state.gaps) gaps.push_back({gap.lo, gap.hi});
  schema::Json json = {{"campaign", state.name},
                       {"identity", state.identity},
                       {"range", {state.goal.range.lo, state.goal.range.hi}},
                       {"goal_end", state.goal_end},
                       {"goal",
                        {{"draws", or_null(state.goal.draws)},
                         {"accepted", or_null(state.goal.accepted)},
                         {"relative_error", or_null(state.goal.relative_error)}}},
                       {"complete", state.gaps.empty()},
                       {"draws", state.draws},
                       {"missing", missing(state)},
                       {"draws_in_ledger", state.draws_in_ledger},
                       {"accepted", state.accepted},
                       {"rejected", state.rejected},
                       {"undecided", state.undecided},
                       {"acceptance", rate_json(state.accepted, state.undecided, state.draws)},
                       {"fault_sample", state.faults},
                       {"draws_per_s", state.draws_per_s},
                       {"gaps", gaps},
                       {"digest", state.digest}};
  return json;
}

DeployingFrom deploying_from(SQLite::Database& database, const schema::CatalogueState& state,
                             const schema::Campaign& campaign, double at_deg) {
  if (!(at_deg >= campaign.threshold_deg && at_deg <= campaign.end_deg)) {
    throw schema::UserError(
        schema::kExitUsage,
        "--at " + schema::shown_number(at_deg) + ": this catalogue knows what deploys from " +
            schema::shown_number(campaign.threshold_deg) + " to " +
            schema::shown_number(campaign.end_deg) + " degrees; ask within that");
  }
  const int sample = static_cast<int>(std::ceil(at_deg / campaign.sample_deg - 1e-9));
  return {at_deg, std::min(schema::count_deploying_from(database, sample), state.accepted)};
}

std::string deploying_text(const DeployingFrom& deploying, const schema::CatalogueState& state) {
  return "from " + schema::shown_number(deploying.at_deg) +
         " deg: " + std::to_string(deploying.accepted) + ", " +
         rate_text(deploying.accepted, state.undecided, state.draws) + "\n";
}

schema::Json deploying_json(const DeployingFrom& deploying, const schema::CatalogueState& state) {
  schema::Json json = rate_json(deploying.accepted, state.undecided, state.draws);
  json["deploys_from_deg"] = deploying.at_deg;
  json["accepted"] = deploying.accepted;
  return json;
}

}  // namespace misalign::search
