// Writes a unit: its row in the ledger, its candidates, fault samples and undecided draws.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <map>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/records/unit_record.hpp"

namespace misalign::schema {

/// Adds draws to the count of what the tests saw: cause, tested_deg, draws.
inline constexpr const char* kAddScreened =
    "INSERT INTO screened (cause, tested_deg, draws) VALUES (?,?,?) ON CONFLICT DO UPDATE SET "
    "draws "
    "= draws + excluded.draws";

/// Writes within transactions that its caller begins and commits. Throws SQLite::Exception.
class UnitWriter {
 public:
  UnitWriter(SQLite::Database& database, const Campaign& campaign,
             const solver::Mechanism& mechanism);

  /// New units with all that belongs to them.
  void write(const std::vector<UnitRecord>& units, std::int64_t run);
  /// A draw of a unit that is there, undecided so far: `decided` is that draw alone, judged again.
  /// A row of the fault sample takes the place of the one that there was, if there was one, with
  /// its weight. UserError (bad_input) if it is in no unit.
  void settle(const UnitRecord& decided);

 private:
  using Screened = std::map<std::pair<int, int>, std::uint64_t>;
  void write_unit(const UnitRecord& unit, std::int64_t run);
  void write_candidate(const Candidate& candidate, std::int64_t unit);
  void write_ascent(const AscentRecord& ascent, std::uint64_t draw);
  CandidateSum sum_of(const UnitRecord& unit) const;
  void write_level(const LevelCount& level, std::int64_t unit);
  void write_undecided(const DrawVerdict& draw, std::int64_t unit, std::int64_t run);
  void write_fault_sample(const DrawVerdict& draw, std::int64_t unit, std::int64_t stands_for);
  void add_screened(const Screened& screened);

  SQLite::Database& database_;
  const Campaign& campaign_;
  const solver::Mechanism& mechanism_;
  SQLite::Statement unit_, candidate_, undecided_, fault_sample_, screened_, level_, sheet_,
      ascent_;
};

}  // namespace misalign::schema
