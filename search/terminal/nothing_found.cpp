#include "search/terminal/nothing_found.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/campaign/climb_cost.hpp"
#include "schema/campaign/split_rate.hpp"
#include "search/terminal/count_text.hpp"
#include "search/terminal/duration.hpp"

namespace misalign::search {
namespace {

using schema::Json;
using schema::shown_number;
using schema::Survival;

constexpr double kShareToTry = 0.001;  // a short run finds candidates at this rate
constexpr std::pair<double, const char*> kShares[] = {{0.5, "half of the draws deploy"},
                                                      {0.1, "one in ten"},
                                                      {0.01, "one in a hundred"},
                                                      {kShareToTry, "one in a thousand"}};

std::string two_digits(double value) { return fmt::format("{:.2g}", value); }
// Writes a number of draws: 88900, 5.3e+08.
std::string some_draws(double draws) {
  return draws < 1e7 ? fmt::format("{:.0f}", std::floor(draws)) : two_digits(draws);
}

int threshold_sample(const Survival& survival, const schema::CatalogueState& state) {
  return static_cast<int>(std::lround(state.threshold_deg / survival.sample_deg()));
}

// The upper limit of the acceptance rate (95 %), with every undecided draw counted as accepted.
double most_possible(const schema::CatalogueState& state) {
  return schema::share_interval(0, state.undecided, state.draws).high;
}

// The extrapolated share at a threshold that no draw reached, bounded by most_possible().
std::optional<schema::SurvivalGuess> guess(const Survival& survival,
                                           const schema::CatalogueState& state) {
  const int sample = threshold_sample(survival, state);
  if (state.accepted > 0 || survival.from(sample).rows > 0) return std::nullopt;
  auto guess = survival.guess(sample);
  if (guess && state.draws > 0) {
    const double most = most_possible(state);
    for (double* share : {&guess->low, &guess->rate, &guess->high}) *share = std::min(*share, most);
  }
  return guess;
}

std::string how_rare(const schema::CatalogueState& state) {
  const double most = most_possible(state);
  const std::string head = "nothing was accepted in " + count_text(state.draws, "draw") +
                           ": the share that deploys from " + shown_number(state.threshold_deg) +
                           " deg is below " + two_digits(most);
  if (state.undecided > 0) {
    return head + " (95 %, if the " + std::to_string(state.undecided) +
           " undecided all count as accepted), and one candidate is expected in more than " +
           some_draws(1 / most) + " draws";
  }
  constexpr std::uint64_t kRuleOfThree = 30;  // least n with 3/n equal to 1 - 0.05^(1/n) to 5 %
  if (state.draws < kRuleOfThree) return head + " (95 %)";
  return head + " (3/n, 95 %), and one candidate is expected in more than " +
         std::to_string(state.draws / 3) + " draws (n/3)";
}

std::string who_survives(const Survival& survival) {
  const std::uint64_t rows = survival.all().rows;
  std::vector<std::string> shares;
  for (const auto& [share, words] : kShares) {
    const auto sample = survival.sample_of_share(share);
    if (!sample) break;
    shares.push_back(fmt::format("{} from {:.10g} deg", words, survival.deg(*sample)));
  }
  if (shares.empty()) {
    return fmt::format(
        "the angles that draws deploy from are not known yet: the fault sample has {}, one in 1024 "
        "or fewer; make more draws",
        count_text(rows, "draw"));
  }
  return fmt::format(
      "{}, the largest angle seen is {:.10g} deg ({} draws judged on their full paths)",
      fmt::join(shares, ", "), survival.deg(survival.deepest()), rows);
}

std::string guess_words(const schema::SurvivalGuess& guess, const schema::CatalogueState& state) {
  std::string text = fmt::format(
      "a guess, extrapolated from the largest of these: about one draw in {} deploys from {:.10g} "
      "deg (one in {} to one in {} if the trend holds)",
      some_draws(1 / guess.rate), state.threshold_deg, some_draws(1 / guess.high),
      some_draws(1 / guess.low));
  if (state.draws_per_s > 0) {
    text += ", " + duration(1 / (guess.rate * state.draws_per_s)) + " at the last run's speed";
  }
  return text;
}

// The cost of a population with the default keys, if plain draws would take longer.
std::optional<schema::ClimbCost> worthwhile_climb(const schema::SurvivalGuess& guess) {
  const schema::ClimbCost cost = schema::climb_cost({}, guess.rate);
  return 1 / guess.rate > cost.draws ? std::optional(cost) : std::nullopt;
}

std::string climb_words(const schema::ClimbCost& cost, const schema::CatalogueState& state) {
  std::string text = fmt::format(
      "splitting finds such rare sheets: \"search\": {{\"method\": \"splitting\"}} in a "
      "copy of the campaign; a population takes as long as about {} draws",
      two_digits(cost.draws));
  if (state.draws_per_s > 0) text += ", " + duration(cost.draws / state.draws_per_s) + ",";
  return text + fmt::format(" and {} populations give the rate", schema::kLeastPopulations);
}

std::string what_to_try(const Survival& survival, const schema::CatalogueState& state) {
  const auto sample = survival.sample_to_try(kShareToTry);
  const std::string other =
      "another misalignment.amplitude_mm or other vertices change all of these shares";
  if (state.ends && state.ends->goal == "shape_rms_mm") {
    return "to find some: a larger search.shape_max_mm, a lower accept.deploys_from_deg, or a "
           "target of less curvature in a copy of the campaign";
  }
  // A threshold cannot lie below the stop.
  if (state.stops_at_deg && (!sample || survival.deg(*sample) < *state.stops_at_deg)) {
    return "to find some: more draws (--draws), or a lower accept.stop_stiffness_mm2_per_rad2 in a "
           "copy of the campaign; " +
           other;
  }
  if (state.has_margin) {
    return "to find some: more draws (--draws), or a smaller accept.least_friction_n_mm_per_mm or "
           "accept.least_moment_n_mm in a copy of the campaign; " +
           other;
  }
  if (!sample || *sample <= 0 || *sample >= threshold_sample(survival, state)) {
    return "to find some: more draws (--draws), or a lower accept.deploys_from_deg in a copy of "
           "the campaign; " +
           other;
  }
  return "to find some soon: accept.deploys_from_deg = " + shown_number(survival.deg(*sample)) +
         " in a copy of the campaign, which about one draw in a thousand survives" +
         (survival.sample_of_share(kShareToTry) ? "" : " (a guess, too)") + "; " + other;
}

}  // namespace

Json survival_json(const Survival& survival, const schema::CatalogueState& state) {
  const auto deg = [&](const std::optional<int>& sample) {
    return sample ? Json(survival.deg(*sample)) : Json();
  };
  Json shares = Json::array();
  for (const auto& [wanted, words] : kShares) {
    const auto sample = survival.sample_of_share(wanted);
    if (!sample) continue;
    const schema::WeightedCount deep = survival.from(*sample);
    const auto [low, high] = schema::share_interval(deep, survival.all());
    shares.push_back({{"share", schema::share(deep, survival.all())},
                      {"share_low", low},
                      {"share_high", high},
                      {"deploys_from_deg", survival.deg(*sample)}});
  }
  Json guessed, climb;
  if (const auto share = guess(survival, state)) {
    guessed = {{"rate", share->rate}, {"rate_low", share->low}, {"rate_high", share->high}};
    if (const auto cost = worthwhile_climb(*share)) {
      climb = {{"levels", cost->levels}, {"moves", cost->moves}, {"worth_draws", cost->draws}};
    }
  }
  const bool any = survival.all().rows > 0;
  return {{"sampled", survival.all().rows},
          {"sampled_effective", survival.all().effective()},
          {"shares", shares},
          {"deepest_deg", any ? Json(survival.deg(survival.deepest())) : Json()},
          {"guess_at_threshold", guessed},
          {"splitting_population", climb},
          {"one_in_a_thousand_deg", deg(survival.sample_to_try(kShareToTry))}};
}

std::vector<std::string> nothing_found(const Survival& survival,
                                       const schema::CatalogueState& state) {
  if (state.accepted > 0 || state.draws == 0 || state.ladder) return {};
  std::vector<std::string> sentences = {how_rare(state), who_survives(survival)};
  if (const auto share = guess(survival, state)) {
    sentences.push_back(guess_words(*share, state));
    if (const auto cost = worthwhile_climb(*share)) sentences.push_back(climb_words(*cost, state));
  }
  sentences.push_back(what_to_try(survival, state));
  sentences.push_back("how to find rarer sheets: search/manual/how-to/rare.md");
  return sentences;
}

std::vector<std::string> nothing_found(SQLite::Database& database,
                                       const schema::CatalogueState& state) {
  if (state.accepted > 0 || state.draws == 0 || state.ladder) return {};
  return nothing_found(schema::read_survival(database), state);
}

}  // namespace misalign::search
