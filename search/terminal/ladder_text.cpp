#include "search/terminal/ladder_text.hpp"

#include <fmt/format.h>

#include "schema/files/text_table.hpp"
#include "search/terminal/count_text.hpp"

namespace misalign::search {
namespace {

using schema::LadderLevel;

std::string rate_text(double rate) { return fmt::format("{:.3g}", rate); }

std::string interval_text(const schema::SplitRate& rate) {
  if (!rate.interval) return "";
  return rate_text(rate.interval->low) + " to " + rate_text(rate.interval->high);
}

std::string share_text(std::uint64_t some, std::uint64_t all) {
  return all > 0
             ? fmt::format("{:.3g} %", 100.0 * static_cast<double>(some) / static_cast<double>(all))
             : "";
}

}  // namespace

std::string population_goal(const schema::CatalogueState& state) {
  const std::uint64_t lo = state.goal.range.lo / schema::kNumbersOfPopulation;
  const std::uint64_t end = state.goal_end / schema::kNumbersOfPopulation;
  std::string text = fmt::format("populations from {}", lo);
  text += end >= schema::kEndOfPopulations ? " up, without end" : fmt::format(" to {}", end);
  if (state.goal.relative_error) {
    text += fmt::format(", or a rate known to {} %",
                        schema::shown_number(100 * *state.goal.relative_error));
  }
  const std::uint64_t missing = state.missing_populations();
  if (missing > 0 && end < schema::kEndOfPopulations) {
    text += fmt::format(", {} of them missing", missing);
  }
  return text;
}

std::string ladder_text(const schema::CatalogueState& state) {
  const schema::LadderState& ladder = *state.ladder;
  if (ladder.levels.empty()) return "no level is known yet: the level finder is still at work\n";
  std::vector<schema::Row> rows = {{"level", "from deg", "share of draws", "95 % interval",
                                    "reach next", "moves accepted", "candidates", "core s"}};
  for (std::size_t k = 0; k < ladder.levels.size(); ++k) {
    const LadderLevel& level = ladder.levels[k];
    const bool is_last = k + 1 == ladder.levels.size();
    rows.push_back({std::to_string(k), k > 0 ? fmt::format("{:.6g}", level.deploys_from_deg) : "",
                    k > 0 ? rate_text(level.rate.mean) : "", k > 0 ? interval_text(level.rate) : "",
                    is_last ? "" : share_text(level.survivors, level.particles),
                    k > 0 ? share_text(level.taken, level.tried) : "", std::to_string(level.met),
                    fmt::format("{:.1f}", level.seconds)});
  }
  std::string text = schema::aligned(rows, {true, true, true, true, true, true, true, true});
  const std::uint64_t top = ladder.levels.size() - 2;  // the level below the last
  std::uint64_t undecided = 0;
  for (const LadderLevel& level : ladder.levels) undecided += level.undecided;
  text += fmt::format("\n{}, {} at the last level, from {}; {} kept{}\n",
                      count_text(ladder.populations, "population"), ladder.rate()->reached,
                      count_text(ladder.levels[top].ancestors, "first draw"),
                      count_text(state.accepted, "candidate"), state.ends ? "" : ", each once");
  if (undecided > 0) {
    text += fmt::format("{} undecided (numerical failures), which were rejected\n",
                        count_text(undecided, "move"));
  }
  const std::string why = schema::why_not_converged(*ladder.rate());
  return why.empty() ? text : text + why + "\n";
}

std::string ladder_summary(const schema::CatalogueState& state) {
  const schema::LadderState& ladder = *state.ladder;
  std::string text =
      count_text(ladder.populations, "population") + ", " + count_text(state.accepted, "candidate");
  if (!ladder.rate() || ladder.populations == 0) return text;
  text += fmt::format(", {} of draws deploy from {:.10g} deg", rate_text(ladder.rate()->mean),
                      state.threshold_deg);
  const std::string interval = interval_text(*ladder.rate());
  if (!interval.empty()) text += fmt::format(" (95 %: {})", interval);
  return text;
}

}  // namespace misalign::search
