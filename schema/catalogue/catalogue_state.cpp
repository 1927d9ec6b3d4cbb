#include "schema/catalogue/catalogue_state.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <optional>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/draw_ranges.hpp"
#include "schema/catalogue/digest.hpp"

namespace misalign::schema {
namespace {

struct UnitRow {
  DrawRange range;
  std::uint64_t accepted, undecided;
  CandidateSum sum;
  std::int64_t run;
  double seconds;
};

// Calls `see` for each unit of the ledger, ascending. UserError (bad_input) at the first unit that
// breaks the table's checks, which SQLite evaluates only when it writes.
template <class See>
void each_unit(SQLite::Database& database, const See& see) {
  SQLite::Statement units(
      database,
      "SELECT lo, hi, accepted, rejected, undecided, digest_part, run, seconds FROM unit "
      "ORDER BY lo");
  std::int64_t end = 0;
  while (units.executeStep()) {
    const auto number = [&](int column) { return units.getColumn(column).getInt64(); };
    const std::int64_t lo = number(0), hi = number(1);
    const std::int64_t accepted = number(2), rejected = number(3), undecided = number(4);
    const SQLite::Column part = units.getColumn(5);
    const bool is_range = lo >= end && hi > lo;
    const bool adds_up = is_range && accepted >= 0 && rejected >= 0 && undecided >= 0 &&
                         accepted <= hi - lo && rejected <= hi - lo - accepted &&
                         undecided == hi - lo - accepted - rejected;
    if (!adds_up || part.getBytes() != 16) {
      throw damaged(database, "unit " + std::to_string(lo) +
                                  (is_range ? " does not add up"
                                            : " is no range of draws behind the one before"));
    }
    end = hi;
    see(UnitRow{{draw_of(units.getColumn(0)), draw_of(units.getColumn(1))},
                draw_of(units.getColumn(2)),
                draw_of(units.getColumn(4)),
                CandidateSum::from_bytes(static_cast<const unsigned char*>(part.getBlob())),
                units.getColumn(6).getInt64(),
                units.getColumn(7).getDouble()});
  }
}

// Rates of the last run that committed a unit.
struct LastRun {
  std::int64_t run = 0;
  std::uint64_t draws = 0;
  double seconds = 0;

  void add(std::int64_t unit_run, const DrawRange& range, double took_s) {
    if (unit_run < run) return;
    if (unit_run > run) *this = {unit_run, 0, 0};
    draws += range.size();
    seconds += took_s;
  }
  // Returns the draws per second of all its ranks together.
  double draws_per_s(SQLite::Database& database) const {
    SQLite::Statement ranks = bound(database, "SELECT ranks FROM run WHERE id = ?", run);
    if (!ranks.executeStep() || seconds == 0) return 0;
    return static_cast<double>(draws) * ranks.getColumn(0).getInt() / seconds;
  }
};

// Adds the totals below the goal's end from the units' sums, in one pass over possibly millions of
// units. Only the unit across the goal's end is counted by its rows.
void add_units(SQLite::Database& database, CatalogueState& state) {
  std::vector<DrawRange> ranges;
  CandidateSum sum;
  LastRun last_run;
  DrawRange cut{state.goal_end, state.goal_end};  // the part below the end of the unit across it
  each_unit(database, [&](const UnitRow& unit) {
    ranges.push_back(unit.range);
    state.draws_in_ledger += unit.range.size();
    last_run.add(unit.run, unit.range, unit.seconds);
    if (unit.range.hi <= state.goal_end) {
      sum.add(unit.sum);
      state.accepted += unit.accepted;
      state.undecided += unit.undecided;
    } else if (unit.range.lo < state.goal_end) {
      cut.lo = unit.range.lo;
    }
  });
  state.draws_per_s = last_run.draws_per_s(database);
  const auto rows_of = [&](const std::string& columns, const std::string& table) {
    return bound(database, "SELECT " + columns + " FROM " + table + " WHERE draw >= ? AND draw < ?",
                 cut.lo, cut.hi);
  };
  SQLite::Statement candidates = rows_of("draw, deploys_from_sample", "candidate");
  while (candidates.executeStep()) {
    ++state.accepted;
    sum.add(draw_of(candidates.getColumn(0)), candidates.getColumn(1).getInt());
  }
  SQLite::Statement undecided = rows_of("count(*)", "undecided");
  if (undecided.executeStep()) state.undecided += draw_of(undecided.getColumn(0));

  const std::vector<DrawRange> merged = united(ranges, state.goal_end);
  for (const DrawRange& range : merged) state.draws += range.size();
  if (state.accepted + state.undecided > state.draws) {
    throw damaged(database, "a unit has draws that are accepted and undecided");
  }
  state.gaps = without({{state.goal.range.lo, state.goal_end}}, merged);
  state.rejected = state.draws - state.accepted - state.undecided;
  state.digest = catalogue_digest(state.identity, merged, state.accepted, state.undecided, sum);
}

// Repeats the table's checks.
bool is_goal(const Goal& goal, std::uint64_t goal_end) {
  const DrawRange& range = goal.range;
  const auto is_whole = [](std::uint64_t number) {
    return number % kNumbersOfPopulation == 0 || number == kEndOfDraws;
  };
  if (goal.of_populations && !(is_whole(range.lo) && is_whole(goal_end) && !goal.accepted)) {
    return false;
  }
  return range.lo < range.hi && range.hi <= kEndOfDraws && goal_end >= range.lo &&
         goal_end <= range.hi && goal.draws.value_or(0) <= kEndOfDraws &&
         goal.accepted.value_or(0) <= kEndOfDraws && goal.relative_error.value_or(1) > 0;
}

CatalogueState state_of(SQLite::Database& database) {
  std::optional<SQLite::Transaction> snapshot;  // for consistent reads below
  if (sqlite3_get_autocommit(database.getHandle())) snapshot.emplace(database);  // or the caller's
  CatalogueState state{};
  SQLite::Statement campaign(
      database,
      "SELECT identity, name, range_lo, range_hi, goal_draws, "
      "goal_accepted, goal_end, goal_relative_error, "
      "json_extract(configuration, '$.seed'), json_extract(configuration, "
      "'$.accept.deploys_from_deg'), json_extract(configuration, "
      "'$.accept.stops_at_deg'), json_extract(configuration, '$.search.method'), "
      "json_extract(configuration, '$.search.starts'), "
      "json_extract(configuration, '$.accept.by'), "
      "coalesce(json_extract(configuration, '$.accept.least_friction_n_mm_per_mm'), "
      "json_extract(configuration, '$.accept.least_moment_n_mm')) "
      "FROM campaign");
  if (!campaign.executeStep()) throw damaged(database, "it names no campaign");
  const auto optional_draw = [&](const SQLite::Column& column) {
    return column.isNull() ? std::nullopt : std::optional(draw_of(column));
  };
  state.identity = text_of(campaign.getColumn(0));
  state.name = text_of(campaign.getColumn(1));
  state.goal.range = {draw_of(campaign.getColumn(2)), draw_of(campaign.getColumn(3))};
  state.goal.draws = optional_draw(campaign.getColumn(4));
  state.goal.accepted = optional_draw(campaign.getColumn(5));
  state.goal_end = draw_of(campaign.getColumn(6));
  if (!campaign.getColumn(7).isNull())
    state.goal.relative_error = campaign.getColumn(7).getDouble();
  state.seed = draw_of(campaign.getColumn(8));
  state.threshold_deg = campaign.getColumn(9).getDouble();
  if (!campaign.getColumn(10).isNull()) state.stops_at_deg = campaign.getColumn(10).getDouble();
  state.by_energy = text_of(campaign.getColumn(13)) == "energy";
  state.has_margin = !campaign.getColumn(14).isNull();
  const std::string method = text_of(campaign.getColumn(11));
  state.goal.of_populations =
      method == "splitting" || text_of(campaign.getColumn(12)) == "splitting";
  if (!is_goal(state.goal, state.goal_end))
    throw damaged(database, "its goal is no range of draws");
  add_units(database, state);
  if (state.goal.of_populations) state.ladder = read_ladder(database, state.goal_end);
  if (method == "optimise" || method == "shape") state.ends = read_ends(database, state.goal_end);

  // Faults of samples that are no candidates, selected by the criterion: a join with candidates
  // would take ten times as long.
  SQLite::Statement faults(
      database,
      "SELECT first_fault, count(*), stands_for FROM fault_sample WHERE first_fault = 'undecided' "
      "OR deploys_from_sample < (SELECT "
      "round(json_extract(configuration, '$.accept.deploys_from_deg') "
      "/ json_extract(configuration, '$.path.sample_deg')) FROM campaign) GROUP BY 1, 3");
  while (faults.executeStep()) {
    state.faults[text_of(faults.getColumn(0))] +=
        sampled_rows(database, faults.getColumn(1), faults.getColumn(2));
  }
  return state;
}

}  // namespace

WeightedCount CatalogueState::sampled() const {
  WeightedCount sum;
  for (const auto& [fault, rows] : faults) sum += rows;
  return sum;
}

std::uint64_t CatalogueState::missing() const {
  std::uint64_t all = 0;
  for (const DrawRange& gap : gaps) all += gap.size();
  return all;
}

std::uint64_t CatalogueState::missing_populations() const {
  std::uint64_t populations = 0;
  for (const DrawRange& gap : gaps) populations += gap.size() / kNumbersOfPopulation;
  return populations;
}

CatalogueState read_state(SQLite::Database& database) {
  return reading(database, [&] { return state_of(database); });
}

Campaign read_campaign_of(SQLite::Database& database, const std::string& path) {
  const std::string configuration = reading(database, [&] {
    SQLite::Statement row(database, "SELECT configuration FROM campaign");
    if (!row.executeStep()) throw damaged(database, "it names no campaign");
    return row.getColumn(0).getString();
  });
  const std::string source = path + ", its configuration";
  return read_campaign(parse_json(configuration, source), source);
}

std::vector<DrawRange> units_done(SQLite::Database& database) {
  return reading(database, [&] {
    std::vector<DrawRange> ranges;
    each_unit(database, [&](const UnitRow& unit) { ranges.push_back(unit.range); });
    return ranges;
  });
}

std::vector<std::uint64_t> draws_of(SQLite::Database& database, const std::string& table,
                                    const DrawRange& range) {
  return reading(database, [&] {
    std::vector<std::uint64_t> draws;
    SQLite::Statement row =
        bound(database, "SELECT draw FROM " + table + " WHERE draw >= ? AND draw < ? ORDER BY draw",
              range.lo, range.hi);
    while (row.executeStep()) draws.push_back(draw_of(row.getColumn(0)));
    return draws;
  });
}

GoalEnd goal_end_of_rows(SQLite::Database& database, const Goal& goal) {
  return reading(database, [&] {
    GoalEnd end(goal);
    if (goal.of_populations) {  // continuing them relies on all
      const auto top = static_cast<std::uint32_t>(read_levels(database).size());
      each_population(database, [&](const DrawRange& unit, const std::vector<LevelCount>& levels) {
        end.add_population(unit, share_reaching(top, levels));
      });
      return end;
    }
    if (!goal.looks_at_results()) return end;
    const auto draws_of = [&](const char* sql) {
      std::vector<std::uint64_t> draws;
      SQLite::Statement rows(database, sql);
      while (rows.executeStep()) draws.push_back(draw_of(rows.getColumn(0)));
      std::sort(draws.begin(), draws.end());
      return draws;
    };
    // The index has a hundredth of the table's size.
    const auto accepted =
        draws_of("SELECT draw FROM candidate INDEXED BY candidate_by_deploys_from");
    const auto undecided = draws_of("SELECT draw FROM undecided");
    const auto within = [](const std::vector<std::uint64_t>& draws, const DrawRange& range) {
      return std::vector(std::lower_bound(draws.begin(), draws.end(), range.lo),
                         std::lower_bound(draws.begin(), draws.end(), range.hi));
    };
    for (const DrawRange& range : units_done(database)) {
      end.add(range, within(accepted, range), within(undecided, range));
    }
    return end;
  });
}

std::uint64_t count_deploying_from(SQLite::Database& database, int sample) {
  return reading(database, [&] {
    SQLite::Statement row =
        bound(database,
              "SELECT count(*) FROM candidate, campaign WHERE deploys_from_sample >= ? "
              "AND draw < goal_end",
              sample);
    row.executeStep();
    return draw_of(row.getColumn(0));
  });
}

}  // namespace misalign::schema
