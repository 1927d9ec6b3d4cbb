// The catalogue of one campaign: what the only writer commits, and what readers ask.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "schema/campaign.hpp"
#include "schema/database.hpp"
#include "schema/digest.hpp"
#include "solver/metrics.hpp"

namespace misalign::schema {

/// A fault_sample or undecided row in the making.
struct DrawVerdict {
  std::uint64_t draw;
  solver::Verdict verdict;
};

struct Candidate {
  std::uint64_t draw;
  solver::Metrics metrics;
  Eigen::Matrix2Xd shifts_mm;  ///< one column per vertex of the sheet
};

/// What became of a range of draws: a unit of the ledger with everything that belongs to it.
struct UnitRecord {
  DrawRange range;
  std::uint64_t accepted = 0, rejected = 0;
  double seconds = 0;
  std::vector<Candidate> candidates;      ///< ascending
  std::vector<DrawVerdict> undecided;     ///< ascending
  std::vector<DrawVerdict> fault_sample;  ///< every draw that is a multiple of kFaultSampleEvery
  std::map<std::pair<int, int>, std::uint64_t> screened;  ///< (Fault, sample) -> draws
};

inline constexpr std::uint64_t kFaultSampleEvery = 1024;
/// With a goal of accepted draws a campaign ends at a multiple of this many draws.
inline constexpr std::uint64_t kAcceptedGranule = 4096;

/// What a run wants; draws count from the range's start.
struct Goal {
  DrawRange range{0, kEndOfDraws};
  std::optional<std::uint64_t> draws, accepted;
  /// Where the goal ends if `accepted` does not end it before.
  std::uint64_t planned_end() const;
};

struct RunInfo {
  std::string host, version, commit, compiler, flags, golden_verdicts;
  int ranks;
};

/// The writer, on rank 0 only.
class Catalogue {
 public:
  /// Opens or creates. An older schema is brought up to date, after a copy of the file.
  /// UserError: see WriterLock and open_for_writing; 5 if another campaign is in it.
  Catalogue(const std::string& path, const Campaign& campaign, const solver::Mechanism& mechanism);

  /// Ranges of draws that are done, ascending.
  std::vector<DrawRange> done() const;
  /// UserError: 5 if a build with other golden verdicts worked on this catalogue.
  void begin_run(const RunInfo& run, const Goal& goal);
  /// One transaction: the unit, its candidates and what else belongs to it, and the goal's end.
  void commit(const UnitRecord& unit, int worker);
  /// `end` says why: complete, stopped, max_time.
  void end_run(const std::string& end);

  /// Where the goal ends as far as is known: earlier than planned once the draws done without a gap
  /// hold the accepted ones that were wanted.
  std::uint64_t goal_end() const { return goal_end_; }

 private:
  void check_same_campaign(const std::string& path) const;
  void migrate(const std::string& path);
  void create();
  void update_goal_end();

  const Campaign& campaign_;
  const solver::Mechanism& mechanism_;
  std::string identity_;
  WriterLock lock_;
  std::unique_ptr<SQLite::Database> database_;
  Goal goal_;
  std::uint64_t goal_end_ = kEndOfDraws;
  std::int64_t run_ = 0;
};

/// Totals of what lies below the goal's end.
struct CatalogueState {
  std::string identity, name;
  Goal goal;
  std::uint64_t goal_end;
  std::uint64_t draws, accepted, rejected, undecided;  ///< below the goal's end
  std::uint64_t draws_in_ledger;
  std::vector<DrawRange> gaps;
  std::string digest;
  std::map<std::string, std::uint64_t>
      faults;          ///< first faults of the rejected draws in the fault sample
  double draws_per_s;  ///< of the last run that committed something, all ranks together
};

CatalogueState read_state(SQLite::Database& database);

/// The campaign that a catalogue belongs to.
Campaign read_campaign_of(SQLite::Database& database, const std::string& path);

/// The draws of all candidates, ascending.
std::vector<std::uint64_t> candidate_draws(SQLite::Database& database);

/// A candidate's row, every column under its name; null if there is none.
Json read_candidate(SQLite::Database& database, std::uint64_t draw);

/// The schema that a candidate was written with: columns that came later are null in it.
int schema_version_of(SQLite::Database& database, std::uint64_t draw);

/// Accepted draws below the goal's end that deploy from `sample` or more.
std::uint64_t count_deploying_from(SQLite::Database& database, int sample);

}  // namespace misalign::schema
