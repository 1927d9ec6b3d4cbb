// The catalogue of one campaign, opened for writing by one process.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/campaign/goal.hpp"
#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/database.hpp"
#include "schema/catalogue/population_rows.hpp"
#include "schema/catalogue/standing.hpp"
#include "schema/catalogue/unit_writer.hpp"
#include "schema/catalogue/write_ahead_log.hpp"
#include "schema/catalogue/writer_lock.hpp"
#include "schema/catalogue/yield.hpp"

namespace misalign::schema {

struct RunInfo {
  std::string host, version, commit, compiler, flags;
  std::string golden_verdicts;  ///< verdicts of every rank; different ones are separated by spaces
  int ranks;
};

enum class Builds {
  same,  ///< all runs of a catalogue must give the same golden verdicts
  mixed
};

/// Cost of this run's commits.
struct CommitCost {
  std::uint64_t commits = 0;
  double seconds = 0, longest_s = 0;
};

class Catalogue {
 public:
  /// Opens a catalogue, or creates it if `missing` allows. An older schema is migrated after the
  /// file is copied. `storage` overrides what the file system reports. If creation fails, no file
  /// is left. UserError: see WriterLock, open_for_writing and storage_failure; foreign if it
  /// belongs to another campaign; bad_input if it is empty but must exist, or has lost its log and
  /// with it a part of what it holds.
  Catalogue(const std::string& path, const Campaign& campaign, const solver::Mechanism& mechanism,
            std::optional<Storage> storage = {}, Missing missing = Missing::created);
  ~Catalogue();
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;

  /// Returns the ranges of finished draws, ascending.
  std::vector<DrawRange> done() const;
  Standing standing() const;
  /// Returns the undecided draws, ascending.
  std::vector<std::uint64_t> undecided() const;
  /// Begins a run. UserError: foreign if a build with other golden verdicts worked on this
  /// catalogue.
  void begin_run(const RunInfo& run, const Goal& goal, Builds builds = Builds::same);
  /// Commits units with their rows, and the goal's end, in one transaction. UserError: failure if
  /// the file was removed meanwhile; see storage_failure.
  void commit(const std::vector<UnitRecord>& units);
  /// Returns of a splitting search: scores of its levels, empty before they are known; pieces of
  /// unfinished populations with a layout, without results; and the result of one piece.
  std::vector<int> levels() const { return read_levels(*database_); }
  std::vector<PieceRow> pieces(const std::string& layout) const;
  std::string result_of(const PieceRow& piece) const;
  /// Store, in one transaction each, the levels in place of this level finder's pieces, and further
  /// pieces.
  void keep_levels(const std::vector<int>& scores, std::uint32_t level_finder);
  void keep_pieces(const std::vector<PieceRow>& pieces);
  /// Copies whole units of another catalogue of this campaign, with its runs, in one transaction
  /// before begin_run. UserError (bad_input) if the other one holds rows that no catalogue may.
  void take_over(SQLite::Database& other, const std::vector<DrawRange>& units);
  /// Stores the new verdict of an undecided draw in one transaction; see UnitWriter.
  void settle(const UnitRecord& decided);
  /// Stores yields of miscut copies in one transaction. Returns the draws that are no candidates,
  /// whose yields are not stored; see write_yields.
  std::vector<std::uint64_t> keep(const std::vector<Yield>& yields,
                                  const std::string& commit_of_build);
  /// Stores certificates in one transaction, replacing earlier ones. Returns the draws that are no
  /// candidates, whose certificates are not stored.
  std::vector<std::uint64_t> keep(const std::vector<CertificateRecord>& certificates);
  /// Copies yields of another catalogue, for candidates that both hold.
  void take_over_yields(SQLite::Database& other);
  /// Copies certificates likewise, see copy_certificates; returns how many were refused because
  /// they are not as they were made.
  std::uint64_t take_over_certificates(SQLite::Database& other);
  /// Ends the run for the reason `end`, see catalogue.sql, and closes the file.
  void end_run(const std::string& end);
  /// Closes the catalogue as one plain file; see close_as_one_file.
  void close();
  /// Copies the log into the file as far as readers allow, so that a copy of the file alone has
  /// that much. Does not wait.
  void fold_in();

  /// Returns the goal's end as far as it is known, see GoalEnd.
  std::uint64_t goal_end() const { return goal_end_->value(); }
  const CommitCost& cost() const { return cost_; }
  const std::string& path() const { return path_; }
  Storage storage() const { return storage_; }

 private:
  void open(Missing missing);
  void check_same_campaign() const;
  void check_same_builds(const RunInfo& run) const;
  void migrate();
  void create();
  void add_to_goal(const UnitRecord& unit, GoalEnd& end) const;
  void store_goal_end(const GoalEnd& end);
  void keep_tables(const std::vector<UnitRecord>& units);
  void take_over_levels(SQLite::Database& other);
  template <class Work>
  void transact(const Work& work);

  const std::string path_;
  const Campaign& campaign_;
  const solver::Mechanism& mechanism_;
  const std::string identity_;
  const Storage storage_;
  const bool lacks_log_;  // its log was missing before it was opened
  WriterLock lock_;
  std::unique_ptr<SQLite::Database> database_;
  std::optional<WriteAheadLog> log_;
  std::optional<UnitWriter> writer_;
  Goal goal_;
  std::optional<GoalEnd> goal_end_;
  std::int64_t run_ = 0;
  CommitCost cost_;
};

/// Returns whether the catalogue holds everything that a run of this campaign to this goal would
/// write. Only reads; false if it cannot be read.
bool holds_all(const std::string& path, const Campaign& campaign, const Goal& goal);

}  // namespace misalign::schema
