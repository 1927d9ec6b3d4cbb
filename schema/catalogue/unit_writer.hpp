// Writes units: rows of the ledger, candidates, fault samples and undecided draws.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <map>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/catalogue/digest.hpp"
#include "schema/records/unit_record.hpp"

namespace misalign::schema {

/// Adds draws to the screened counts: cause, tested_deg, draws.
inline constexpr const char* kAddScreened =
    "INSERT INTO screened (cause, tested_deg, draws) VALUES (?,?,?) ON CONFLICT DO UPDATE SET "
    "draws "
    "= draws + excluded.draws";

/// Writes within its caller's transactions. Throws SQLite::Exception.
class UnitWriter {
 public:
  UnitWriter(SQLite::Database& database, const Campaign& campaign,
             const solver::Mechanism& mechanism);

  /// Writes new units with all their rows.
  void write(const std::vector<UnitRecord>& units, std::int64_t run);
  /// Stores the new verdict of an undecided draw: `decided` is a unit of that draw alone. A row of
  /// the fault sample is replaced, with its weight. UserError (bad_input) if the draw is in no
  /// unit.
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
