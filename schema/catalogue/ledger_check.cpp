#include "schema/catalogue/ledger_check.hpp"

#include <algorithm>
#include <cmath>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/draw_ranges.hpp"
#include "schema/catalogue/campaign_check.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/catalogue/file_check.hpp"
#include "schema/catalogue/unit_writer.hpp"
#include "schema/catalogue/yield.hpp"
#include "schema/files/hexadecimal.hpp"
#include "schema/records/fault_sample.hpp"

namespace misalign::schema {
namespace {

class LedgerCheck {
 public:
  LedgerCheck(SQLite::Database& database, const Campaign& campaign)
      : database_(database), campaign_(campaign) {}

  CheckedLedger take() {
    findings_ = check_file(database_);
    check_campaign();
    look_at_state();
    read_units();
    sum_candidates();
    sum_levels();
    check_sheets_once();
    count_undecided();
    count_fault_sample();
    check_units();
    check_fault_sample();
    check_sampled_verdicts();
    check_verdicts();
    check_digest();
    check_campaign_row(database_, campaign_, state_, findings_);
    check_screened(database_, campaign_, findings_);
    check_ascents(database_, campaign_, findings_);
    check_runs(database_, campaign_, findings_);
    return {std::move(findings_), std::move(state_), std::move(why_no_state_)};
  }

 private:
  // A count of a unit's row, and the count of the rows that belong to it.
  struct Part {
    std::uint64_t stored, counted = 0;
  };
  struct Unit {
    DrawRange range;
    Part accepted, undecided, fault_sample;
    CandidateSum stored, summed;
    FaultSampleRule rule;
  };

  void add(const std::string& where, const std::string& column, const Json& stored,
           const Json& recomputed) {
    findings_.push_back(differs(where, column, stored, recomputed));
  }

  void check_campaign() {
    SQLite::Statement row(database_, "SELECT identity FROM campaign");
    if (!row.executeStep()) throw damaged(database_, "it names no campaign");
    const std::string stored = text_of(row.getColumn(0)), of_this = identity(campaign_);
    if (stored != of_this) add("campaign", "identity", stored, of_this);
  }

  void look_at_state() {
    try {
      state_ = read_state(database_);
    } catch (const UserError& error) {
      if (error.cause() != Cause::bad_input) throw;  // a fault of the disk, not of the file
      why_no_state_ = error.what();
    }
  }

  void read_units() {
    SQLite::Statement row(
        database_,
        "SELECT lo, hi, accepted, undecided, rejected, digest_part, "
        "schema_version FROM unit LEFT JOIN run ON run.id = unit.run ORDER BY lo");
    std::uint64_t end = 0;
    while (row.executeStep()) {
      const DrawRange range{draw_of(row.getColumn(0)), draw_of(row.getColumn(1))};
      if (range.hi <= range.lo || range.hi > kEndOfDraws) {
        add(name(range.lo), "hi", row.getColumn(1).getInt64(), "above lo");
      }
      if (range.lo < end) add(name(range.lo), "lo", range.lo, "not below " + std::to_string(end));
      end = std::max(end, range.hi);
      const std::uint64_t rejected =
          range.size() - draw_of(row.getColumn(2)) - draw_of(row.getColumn(3));
      const std::uint64_t stored = draw_of(row.getColumn(4));
      if (rejected != stored) add(name(range.lo), "rejected", stored, rejected);
      Unit unit{range,
                {draw_of(row.getColumn(2))},
                {draw_of(row.getColumn(3))},
                {},
                {},
                {},
                FaultSampleRule(row.getColumn(6).getInt())};
      unit.fault_sample.stored = campaign_.search.splitting ? 0 : unit.rule.rows_in(range);
      if (row.getColumn(5).getBytes() == 16) {
        unit.stored =
            CandidateSum::from_bytes(static_cast<const unsigned char*>(row.getColumn(5).getBlob()));
      }
      units_.emplace(range.lo, unit);
    }
  }

  static std::string draw_in(SQLite::Statement& row, int column = 0) {
    return "draw " + std::to_string(draw_of(row.getColumn(column)));
  }
  static std::string name(std::uint64_t unit) { return "unit " + std::to_string(unit); }

  // Returns the unit that a row names, if it exists and holds the row's draw.
  Unit* unit_of(const std::string& table, std::uint64_t draw, std::uint64_t unit) {
    const auto at = units_.find(unit);
    if (at == units_.end()) return nullptr;  // foreign_key_check reports it
    const DrawRange& range = at->second.range;
    if (draw >= range.lo && draw < range.hi) return &at->second;
    const std::string draws =
        "draws " + std::to_string(range.lo) + " to " + std::to_string(range.hi);
    add("draw " + std::to_string(draw), table + ".unit", unit, "another: this one holds " + draws);
    return nullptr;
  }

  void sum_candidates() {
    const int first = campaign_.threshold_sample();
    const int last = static_cast<int>(std::lround(campaign_.end_deg / campaign_.sample_deg));
    SQLite::Statement row(database_, candidates_sql());
    while (row.executeStep()) {
      const std::uint64_t draw = draw_of(row.getColumn(0));
      const int sample = row.getColumn(2).getInt();  // of 64 bits, the lower ones
      if (row.getColumn(2).getInt64() != std::clamp(sample, first, last)) {
        add("draw " + std::to_string(draw), "deploys_from_sample", row.getColumn(2).getInt64(),
            "one of the campaign's " + std::to_string(first) + " to " + std::to_string(last));
      }
      const std::string sheet = campaign_.search.stores_sheets() ? checked_sheet(draw, row) : "";
      if (state_ && draw < state_->goal_end) {
        ++counted_.accepted;
        counted_.sum.add(draw, sample, sheet);
      }
      if (Unit* unit = unit_of("candidate", draw, draw_of(row.getColumn(1)))) {
        ++unit->accepted.counted;
        unit->summed.add(draw, sample, sheet);
      }
    }
  }

  std::string candidates_sql() const {
    const std::string row = "SELECT draw, unit, deploys_from_sample";
    if (!campaign_.search.stores_sheets()) return row + " FROM candidate";
    return row + ", hash, displacements_mm FROM candidate LEFT JOIN sheet USING (draw)";
  }

  // Returns the hash that identifies a sheet by its displacements.
  std::string checked_sheet(std::uint64_t draw, SQLite::Statement& row) {
    const std::string hash = sheet_hash(text_of(row.getColumn(4)));
    if (row.getColumn(3).getString() != hash) {
      add("draw " + std::to_string(draw), "sheet.hash", "another", "of its displacements");
    }
    return hash;
  }

  // Adds the counts of each population's levels.
  void sum_levels() {
    if (!campaign_.search.splitting) return;
    const Splitting& splitting = *campaign_.search.splitting;
    const std::vector<int> scores = read_levels(database_);
    const std::vector<int> named = named_scores(splitting, campaign_.sample_deg);
    if (!scores.empty() && !named.empty() && scores != named) {
      add("catalogue", "level.score", Json(scores), Json(named));
    }
    for (auto& [lo, unit] : units_) {
      const std::vector<LevelCount> levels = read_population(database_, lo);
      for (const LevelCount& level : levels) check_level(name(lo), level, splitting, findings_);
      const CandidateSum sum = sum_of_levels(lo, levels);
      unit.summed.add(sum);
      if (state_ && lo < state_->goal_end) counted_.sum.add(sum);
    }
  }

  // Checks that each sheet has only one number.
  void check_sheets_once() {
    if (!campaign_.search.has_each_once()) return;
    SQLite::Statement row(
        database_, "SELECT max(draw), min(draw) FROM sheet GROUP BY hash HAVING count(*) > 1");
    while (row.executeStep()) {
      add(draw_in(row), "sheet.hash", "that of " + draw_in(row, 1), "its own");
    }
  }

  void count_undecided() {
    SQLite::Statement row(database_, "SELECT draw, unit FROM undecided");
    while (row.executeStep()) {
      if (Unit* unit = unit_of("undecided", draw_of(row.getColumn(0)), draw_of(row.getColumn(1))))
        ++unit->undecided.counted;
    }
  }

  // Counts the rows of the fault sample. None is there twice, so that equal numbers mean a row for
  // each draw of the rule.
  void count_fault_sample() {
    SQLite::Statement row(database_, "SELECT draw, unit, stands_for FROM fault_sample");
    while (row.executeStep()) {
      const std::uint64_t draw = draw_of(row.getColumn(0)), weight = draw_of(row.getColumn(2));
      Unit* unit = unit_of("fault_sample", draw, draw_of(row.getColumn(1)));
      if (!unit) continue;
      ++unit->fault_sample.counted;
      const std::string where = "draw " + std::to_string(draw);
      const std::uint64_t spacing = unit->rule.spacing(draw);
      if (!unit->rule.holds(draw)) {
        add(where, "fault_sample.draw", draw, "a multiple of " + std::to_string(spacing));
      } else if (weight != spacing) {
        add(where, "fault_sample.stands_for", weight, spacing);
      }
    }
  }

  void check_units() {
    for (const auto& [lo, unit] : units_) {
      const auto compare = [&, where = name(lo)](const char* column, const Part& part) {
        if (part.stored != part.counted) add(where, column, part.stored, part.counted);
      };
      compare("accepted", unit.accepted);
      compare("undecided", unit.undecided);
      compare("rows of fault_sample", {unit.fault_sample.counted, unit.fault_sample.stored});
      if (unit.stored != unit.summed) {
        add(name(lo), "digest_part", hex(unit.stored.bytes()), hex(unit.summed.bytes()));
      }
    }
  }

  void check_fault_sample() {
    if (campaign_.search.optimisation) return;  // the sample holds the draws, not the optima
    SQLite::Statement row(database_,
                          "SELECT draw, fault_sample.deploys_from_sample, "
                          "candidate.deploys_from_sample FROM fault_sample JOIN candidate USING "
                          "(draw) WHERE fault_sample.deploys_from_sample != "
                          "candidate.deploys_from_sample");
    while (row.executeStep()) {
      add(draw_in(row), "fault_sample.deploys_from_sample", row.getColumn(1).getInt(),
          row.getColumn(2).getInt());
    }
  }

  // Checks that a sampled draw is accepted exactly if it is a candidate, and undecided only if no
  // other row has it.
  void check_sampled_verdicts() {
    const std::string accepted = "first_fault != 'undecided' AND deploys_from_sample >= " +
                                 std::to_string(campaign_.threshold_sample());
    const auto compare = [&](const std::string& column, const std::string& sampled,
                             const std::string& table) {
      SQLite::Statement row(database_, "SELECT draw, " + sampled +
                                           " AS sampled FROM fault_sample WHERE sampled != "
                                           "EXISTS (SELECT 1 FROM " +
                                           table + " WHERE draw = fault_sample.draw)");
      while (row.executeStep()) {
        const bool is_sampled = row.getColumn(1).getInt() != 0;
        add(draw_in(row), "fault_sample." + column, is_sampled ? column : "not " + column,
            is_sampled ? "not " + column : column);
      }
    };
    compare("accepted", "(" + accepted + ")", "candidate");
    compare("undecided", "(first_fault = 'undecided')", "undecided");
  }

  // Checks that no draw is both accepted and undecided.
  void check_verdicts() {
    SQLite::Statement row(database_, "SELECT draw FROM undecided JOIN candidate USING (draw)");
    while (row.executeStep()) {
      add(draw_in(row), "verdict", "undecided", "accepted");
    }
  }

  void check_digest() {
    if (!state_ && !findings_.empty()) return;
    const Json details = {{"where", "catalogue"}, {"column", "digest"}};
    if (!state_) return findings_.push_back({why_no_state_, details});
    std::vector<DrawRange> ranges;
    for (const auto& [lo, unit] : units_) ranges.push_back(unit.range);
    const std::string digest =
        catalogue_digest(identity(campaign_), united(ranges, state_->goal_end), counted_.accepted,
                         state_->undecided, counted_.sum);
    if (digest != state_->digest) add("catalogue", "digest", state_->digest, digest);
  }

  SQLite::Database& database_;
  const Campaign& campaign_;
  std::optional<CatalogueState> state_;
  std::string why_no_state_;
  std::map<std::uint64_t, Unit> units_;  // by their lower ends
  struct {
    std::uint64_t accepted = 0;
    CandidateSum sum;
  } counted_;  // candidates below the goal's end
  std::vector<Finding> findings_;
};

}  // namespace

CheckedLedger read_checked(SQLite::Database& database, const Campaign& campaign) {
  return reading(database, [&] {
    CheckedLedger checked = LedgerCheck(database, campaign).take();
    for (Finding& finding : check_yields(database)) checked.findings.push_back(std::move(finding));
    return checked;
  });
}

std::vector<Finding> check_ledger(SQLite::Database& database, const Campaign& campaign) {
  return read_checked(database, campaign).findings;
}

}  // namespace misalign::schema
