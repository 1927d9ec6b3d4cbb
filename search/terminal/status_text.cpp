#include "search/terminal/status_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "schema/campaign/share_interval.hpp"
#include "schema/files/text_table.hpp"
#include "search/terminal/ladder_text.hpp"
#include "search/terminal/shell_word.hpp"

namespace misalign::search {
namespace {

std::string percent(double value) { return fmt::format("{:.4g} %", 100 * value); }

std::string interval_text(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials) {
  const auto [low, high] = schema::share_interval(hits, undecided, trials);
  return percent(low) + " to " + percent(high);
}

bool endless(std::uint64_t end) { return end == schema::kEndOfDraws; }

// The table of plain draws by their verdicts.
std::string draws_text(const schema::CatalogueState& state,
                       const std::optional<schema::DeployingFrom>& deploying) {
  const auto row = [&](const std::string& name, std::uint64_t draws, std::uint64_t total) {
    return schema::Row{name, std::to_string(draws),
                       total > 0 ? percent(schema::share(draws, total)) : "", ""};
  };
  std::vector<schema::Row> rows = {{"", "draws", "share", "95 % interval"},
                                   {"done", std::to_string(state.draws)}};
  rows.push_back(row((state.by_energy ? "  accepted by energy from " : "  accepted from ") +
                         schema::shown_number(state.threshold_deg) + " deg",
                     state.accepted, state.draws));
  rows.back()[3] = interval_text(state.accepted, state.undecided, state.draws);
  if (deploying) {
    rows.push_back(row("    from " + schema::shown_number(deploying->at_deg) + " deg",
                       deploying->accepted, state.draws));
    rows.back()[3] = interval_text(deploying->accepted, state.undecided, state.draws);
  }
  rows.push_back(row("  rejected", state.rejected, state.draws));
  rows.push_back(row("  undecided", state.undecided, state.draws));
  if (state.undecided > 0)
    rows.back()[3] = "lower limits count them as rejected, upper limits as accepted";
  if (!endless(state.goal_end)) {
    const std::uint64_t draws = state.missing();
    rows.push_back(
        {"missing", std::to_string(draws), "",
         draws > 0 ? "of the last run's goal; time or a signal may end a run first" : ""});
  }
  if (state.draws_in_ledger > state.draws) {
    rows.push_back({"beyond goal", std::to_string(state.draws_in_ledger - state.draws), "",
                    "not counted above; queries and report include them"});
  }
  const schema::WeightedCount sampled = state.sampled();
  if (sampled.rows > 0) {
    rows.push_back({"first faults", std::to_string(sampled.rows), "", "of a sample"});
  }
  std::size_t listed = 0;
  for (const auto& [fault, draws] : state.faults) {
    if (++listed > schema::kMostListed) break;  // only a hostile file has more
    const auto [low, high] = schema::share_interval(draws, sampled);
    rows.push_back({"  " + schema::shortened(fault, 40), std::to_string(draws.rows),
                    percent(schema::share(draws, sampled)), percent(low) + " to " + percent(high)});
  }

  return schema::aligned(rows, {false, true, true, false});
}

std::string goal_text(const schema::CatalogueState& state) {
  if (state.ladder) return population_goal(state);
  std::string goal =
      "draws from " + std::to_string(state.goal.range.lo) +
      (endless(state.goal_end) ? " up, without end" : " to " + std::to_string(state.goal_end));
  if (state.goal.accepted) goal += ", or " + std::to_string(*state.goal.accepted) + " accepted";
  if (state.goal.relative_error) {
    goal += ", or a rate known to " + schema::shown_number(100 * *state.goal.relative_error) + " %";
  }
  return goal;
}

// Summary of the optima of accepted draws.
std::string ends_text(const schema::EndsState& ends) {
  std::string text = fmt::format("{} sheets", ends.sheets);
  if (ends.best) {
    text += fmt::format(", best {} {:.4g}, median {:.4g}", ends.goal, *ends.best, *ends.median);
  }
  if (ends.kept_as_drawn > 0) text += fmt::format("; {} kept as drawn", ends.kept_as_drawn);
  return text;
}

}  // namespace

std::string status_text(const schema::CatalogueState& state,
                        const std::optional<schema::DeployingFrom>& deploying, const Paint& paint) {
  const bool complete = state.gaps.empty();
  const double draws_per_s = std::round(state.draws_per_s * 10) / 10;
  std::vector<schema::Row> rows = {{"goal", goal_text(state)}};
  if (!state.ladder) rows.push_back({"speed", schema::shown_number(draws_per_s) + " draws/s"});
  if (state.ends) rows.push_back({"optima", ends_text(*state.ends)});
  rows.push_back({"digest", state.digest});
  std::string table = state.ladder ? ladder_text(state) : draws_text(state, deploying);
  const std::size_t header = table.find('\n');
  table = paint.bold(table.substr(0, header)) + table.substr(header);
  return paint.bold(schema::printable(state.name)) + " (" +
         schema::printable(state.identity.substr(0, 8)) +
         "): " + (complete ? paint.good("complete") : paint.bold("work remains")) + "\n" +
         schema::aligned(rows, {false, false}) + "\n" + table;
}

std::string next_step(const schema::CatalogueState& state, const std::string& path,
                      const std::string& campaign_path) {
  const std::string file = shell_path(path);
  if (!state.gaps.empty()) {
    const schema::DrawRange& range = state.goal.range;
    std::string limit;
    const std::uint64_t each = state.ladder ? schema::kNumbersOfPopulation : 1;
    const std::string count = state.ladder ? " --populations " : " --draws ";
    if (state.goal.draws) limit += count + std::to_string(*state.goal.draws / each);
    if (state.goal.accepted) limit += " --accepted " + std::to_string(*state.goal.accepted);
    if (state.goal.relative_error) {
      limit += " --relative-error " + schema::shown_number(*state.goal.relative_error);
    }
    const std::uint64_t end = state.ladder ? schema::kEndOfPopulations : schema::kEndOfDraws;
    if (range.lo > 0 || range.hi / each < end) {
      limit += fmt::format(" --range {}:{}", range.lo / each, range.hi / each);
    }
    if (state.seed != 1) limit += " --seed " + std::to_string(state.seed);
    return "misalign search " +
           (campaign_path.empty() ? "CAMPAIGN.json" : shell_path(campaign_path)) + " --catalogue " +
           file + limit + " resumes";
  }
  if (state.accepted == 0 && state.draws_in_ledger > state.draws) {
    return "nothing was accepted up to the goal; the catalogue has more draws: misalign query " +
           file + " best";
  }
  if (state.accepted == 0) {
    return "misalign report " + file + " --output report.html shows the D of draws";
  }
  if (state.ends && state.ends->goal == "shape_rms_mm") {
    return "misalign query " + file +
           " --front shape_rms_mm,slope_min_mm_per_deg,thickness_mm; misalign export " + file +
           " --best 3 --by shape_rms_mm --output found";
  }
  if (state.ends) {
    return "misalign query " + file + " ends; misalign export " + file +
           " --best 3 --by end_value --output found";
  }
  return "misalign query " + file + " best; misalign export " + file + " --best 3 --output found";
}

schema::DeployingFrom deploying_from(SQLite::Database& database,
                                     const schema::CatalogueState& state,
                                     const schema::Campaign& campaign, double at_deg) {
  if (campaign.search.has_ends()) {
    throw schema::UserError(
        solver::OptionFault{"at_deg", schema::shown_number(at_deg),
                            "this campaign optimises its draws, and their own D is not stored",
                            "use a plain campaign with the same draws"});
  }
  if (!(at_deg >= campaign.threshold_deg && at_deg <= campaign.end_deg)) {
    throw schema::UserError(solver::OptionFault{
        "at_deg", schema::shown_number(at_deg),
        "this catalogue holds D from " + schema::shown_number(campaign.threshold_deg) + " to " +
            schema::shown_number(campaign.end_deg) + " degrees",
        "give an angle in this range"});
  }
  const int sample = static_cast<int>(std::ceil(at_deg / campaign.sample_deg - 1e-9));
  return {at_deg, std::min(schema::count_deploying_from(database, sample), state.accepted)};
}

}  // namespace misalign::search
