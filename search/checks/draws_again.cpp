#include "search/checks/draws_again.hpp"

#include <algorithm>
#include <map>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/ends_state.hpp"
#include "schema/files/json_values.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "search/splitting/origin.hpp"

namespace misalign::search {
namespace {

using schema::Json;

bool is_undecided(const StoredVerdict& verdict) {
  return verdict.first_fault == solver::fault_name(solver::Fault::undecided);
}

StoredVerdict as_stored(std::uint64_t draw, const solver::Verdict& verdict,
                        const schema::Campaign& campaign, const solver::Mechanism& mechanism) {
  const int sample = verdict.fault_sample();
  return {draw, verdict.deploys_from_sample, solver::fault_name(verdict.first_fault),
          sample > 0 ? std::optional(sample * campaign.sample_deg) : std::nullopt,
          schema::where_label(mechanism, verdict)};
}

void compare(const StoredVerdict& stored, const StoredVerdict& again,
             std::vector<schema::Finding>& findings) {
  if (is_undecided(stored) || is_undecided(again)) return;
  const auto compare = [&](const char* column, const Json& a, const Json& b) {
    if (a == b) return;
    findings.push_back(schema::differs("draw " + std::to_string(stored.draw),
                                       "fault_sample." + std::string(column), a, b));
  };
  compare("deploys_from_sample", stored.deploys_from_sample, again.deploys_from_sample);
  if (!solver::may_be_one_fault(stored.first_fault, again.first_fault)) {
    compare("first_fault", stored.first_fault, again.first_fault);
  }
  compare("fault_deg", schema::or_null(stored.fault_deg), schema::or_null(again.fault_deg));
  compare("where", stored.where, again.where);
}

// Maps draws to the samples that they deploy from; 0: undecided.
using Accepted = std::map<std::uint64_t, std::int64_t>;

Accepted stored_accepted(SQLite::Database& database, const schema::DrawRange& unit) {
  return schema::reading(database, [&] {
    Accepted accepted;
    SQLite::Statement row(
        database,
        "SELECT draw, deploys_from_sample FROM candidate WHERE draw >= ?1 AND draw < ?2 UNION ALL "
        "SELECT draw, 0 FROM undecided WHERE draw >= ?1 AND draw < ?2");
    row.bind(1, schema::stored(unit.lo));
    row.bind(2, schema::stored(unit.hi));
    while (row.executeStep()) {
      accepted[schema::draw_of(row.getColumn(0))] = row.getColumn(1).getInt64();
    }
    return accepted;
  });
}

// Returns the number of draws not compared, which only one of the two has decided.
std::uint64_t compare(const Accepted& stored, const Accepted& again,
                      std::vector<schema::Finding>& findings) {
  std::uint64_t in_one_only = 0;
  Accepted all = stored;
  all.insert(again.begin(), again.end());
  for (const auto& [draw, ignored] : all) {
    const auto a = stored.find(draw), b = again.find(draw);
    const bool was_open = a != stored.end() && a->second == 0;
    const bool is_open = b != again.end() && b->second == 0;
    if (was_open || is_open) {
      in_one_only += was_open != is_open;
      continue;
    }
    const std::string where = "draw " + std::to_string(draw);
    const auto verdict = [](bool is_accepted) { return is_accepted ? "accepted" : "rejected"; };
    if (a == stored.end() || b == again.end()) {
      findings.push_back(
          schema::differs(where, "verdict", verdict(a != stored.end()), verdict(b != again.end())));
    } else if (a->second != b->second) {
      findings.push_back(schema::differs(where, "deploys_from_sample", a->second, b->second));
    }
  }
  return in_one_only;
}

// Compares a candidate's ascent with the stored one.
void compare_ways(SQLite::Database& database, const schema::Candidate& again, std::uint64_t draw,
                  std::vector<schema::Finding>& findings) {
  const Json row = schema::read_ascent(database, draw);
  if (!row.is_object()) return;  // another check reports it
  compare_ascents(row, ascent_row(*again.ascent),
                  [&](const std::string& column, const Json& stored, const Json& recomputed) {
                    findings.push_back(schema::differs("draw " + std::to_string(draw), column,
                                                       stored, recomputed));
                  });
}

// Compares a candidate's optimum with the stored one.
void compare_end(SQLite::Database& database, const schema::Candidate& again,
                 std::vector<schema::Finding>& findings) {
  const Json row = schema::read_candidate(database, again.draw);
  if (!row.is_object()) return;  // another check reports it
  const Json ends = schema::displacements_json(again.shifts_mm);
  const Json stored = schema::json_of(row.value("displacements_mm", Json()));
  if (stored == ends) return;
  findings.push_back(schema::differs("draw " + std::to_string(again.draw), "displacements_mm",
                                     stored.dump(), ends.dump()));
}

}  // namespace

SQLite::Statement fault_sample_rows(SQLite::Database& database, const schema::DrawRange& range) {
  SQLite::Statement row(database,
                        "SELECT draw, deploys_from_sample, first_fault, fault_deg, \"where\" FROM "
                        "fault_sample WHERE draw >= ? AND draw < ? ORDER BY draw");
  row.bind(1, schema::stored(range.lo));
  row.bind(2, schema::stored(range.hi));
  return row;
}

std::vector<StoredVerdict> stored_verdicts(SQLite::Database& database,
                                           const schema::DrawRange& range) {
  return schema::reading(database, [&] {
    std::vector<StoredVerdict> rows;
    SQLite::Statement row = fault_sample_rows(database, range);
    while (row.executeStep()) {
      const SQLite::Column fault = row.getColumn(3);
      rows.push_back({schema::draw_of(row.getColumn(0)), row.getColumn(1).getInt64(),
                      schema::text_of(row.getColumn(2)),
                      fault.isNull() ? std::nullopt : std::optional(fault.getDouble()),
                      schema::text_of(row.getColumn(4))});
    }
    return rows;
  });
}

void compare_verdict(const StoredVerdict& stored, const CandidateCheck& check,
                     std::vector<schema::Finding>& findings) {
  compare(stored,
          as_stored(stored.draw, check.verdict(stored.draw), check.campaign(), check.mechanism()),
          findings);
}

std::uint64_t make_unit_again(SQLite::Database& database, DrawEvaluator& evaluator,
                              const schema::DrawRange& unit,
                              std::vector<schema::Finding>& findings) {
  const Accepted stored = stored_accepted(database, unit);
  const std::vector<StoredVerdict> verdicts = stored_verdicts(database, unit);
  const schema::UnitRecord record = work_off(evaluator, unit);
  Accepted again;
  for (const schema::Candidate& c : record.candidates) {
    again[c.draw] = c.metrics.deploys_from_sample;
    if (!evaluator.campaign().search.has_ends()) continue;
    compare_end(database, c, findings);
    if (c.ascent) compare_ways(database, c, c.draw, findings);
  }
  for (const schema::DrawVerdict& d : record.undecided) again[d.draw] = 0;
  const std::uint64_t in_one_only = compare(stored, again, findings);
  for (const schema::DrawVerdict& sampled : record.fault_sample) {
    const auto row = std::find_if(verdicts.begin(), verdicts.end(),
                                  [&](const StoredVerdict& v) { return v.draw == sampled.draw; });
    if (row == verdicts.end()) continue;  // the ledger's check reports a missing row
    compare(*row,
            as_stored(sampled.draw, sampled.verdict, evaluator.campaign(), evaluator.mechanism()),
            findings);
  }
  return in_one_only;
}

namespace {

// Returns the number under which a sheet is kept, preferably `draw`; none if it is not kept.
std::optional<std::uint64_t> kept_number(SQLite::Database& database, const std::string& hash,
                                         std::uint64_t draw) {
  SQLite::Statement row(database, "SELECT draw FROM sheet WHERE hash = ? ORDER BY draw != ?");
  row.bind(1, hash.data(), static_cast<int>(hash.size()));
  row.bind(2, schema::stored(draw));
  return row.executeStep() ? std::optional(schema::draw_of(row.getColumn(0))) : std::nullopt;
}

// Returns the last draw that is kept, if stop.accepted limits them; otherwise the end of all draws.
std::uint64_t end_of_kept(SQLite::Database& database, const schema::Campaign& campaign) {
  SQLite::Statement row(database, "SELECT count(*), coalesce(max(draw), 0) FROM sheet");
  row.executeStep();
  const auto& most = campaign.stop.accepted;
  return most && schema::draw_of(row.getColumn(0)) >= *most ? schema::draw_of(row.getColumn(1))
                                                            : schema::kEndOfDraws;
}

}  // namespace

void make_population_again(SQLite::Database& database, Climber& climber, std::uint64_t unit,
                           std::vector<schema::Finding>& findings) {
  const schema::Campaign& campaign = climber.campaign();
  const Ladder ladder = stored_ladder(campaign, schema::read_levels(database));
  const auto number = static_cast<std::uint32_t>(unit / schema::kNumbersOfPopulation);
  const PopulationRecord again = climbed(ladder, number, climber);
  schema::reading(database, [&] {
    const std::string where = "population " + std::to_string(number);
    schema::each_difference(
        schema::read_population(database, unit), again.levels,
        [&](const std::string& count, const Json& stored, const Json& recomputed) {
          findings.push_back(schema::differs(where, count, stored, recomputed));
        });
    const std::uint64_t end = end_of_kept(database, campaign);
    Accepted stored = stored_accepted(database, {unit, unit + schema::kNumbersOfPopulation});
    for (const FoundCandidate& found : again.found) {
      const std::uint64_t draw = number_of(found.origin, *campaign.search.splitting);
      const auto kept = kept_number(
          database,
          schema::sheet_hash(schema::displacements_json(found.candidate.shifts_mm).dump()), draw);
      const auto& ascent = found.candidate.ascent;
      const bool is_elsewhere = !ascent && kept && *kept < draw;  // every start keeps its optimum
      const bool is_right = kept == draw || is_elsewhere || draw > end;
      if (!is_right) {
        findings.push_back(schema::differs("draw " + std::to_string(draw), "kept as",
                                           schema::or_null(kept), draw));
      }
      if (const auto at = stored.find(draw); at != stored.end()) {
        const int sample = found.candidate.metrics.deploys_from_sample;
        if (at->second != sample) {
          findings.push_back(schema::differs("draw " + std::to_string(draw), "deploys_from_sample",
                                             at->second, sample));
        }
        if (ascent) compare_ways(database, found.candidate, draw, findings);
        stored.erase(at);
      }
    }
    for (const auto& [draw, sample] : stored) {
      findings.push_back(
          schema::differs("draw " + std::to_string(draw), "verdict", "accepted", "not met"));
    }
  });
}

}  // namespace misalign::search
