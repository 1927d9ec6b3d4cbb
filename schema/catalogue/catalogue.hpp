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
  std::string golden_verdicts;  ///< of every rank; several, with spaces between, if they differ
  int ranks;
};

enum class Builds {
  same,  ///< all runs of a catalogue must give the same golden verdicts
  mixed
};

/// What committing has cost this run.
struct CommitCost {
  std::uint64_t commits = 0;
  double seconds = 0, longest_s = 0;
};

class Catalogue {
 public:
  /// Opens, or creates if that is wanted. An older schema is brought up to date, after a copy of
  /// the file. `storage` overrides what the file system says. If creating fails, nothing is left
  /// behind. UserError: see WriterLock, open_for_writing and storage_failure; foreign if another
  /// campaign is in it; bad_input if it is empty and should be there.
  Catalogue(const std::string& path, const Campaign& campaign, const solver::Mechanism& mechanism,
            std::optional<Storage> storage = {}, Missing missing = Missing::created);
  ~Catalogue();
  Catalogue(const Catalogue&) = delete;
  Catalogue& operator=(const Catalogue&) = delete;

  /// Ranges of draws that are done, ascending.
  std::vector<DrawRange> done() const;
  Standing standing() const;
  /// Draws that no run could decide, ascending.
  std::vector<std::uint64_t> undecided() const;
  /// UserError: foreign if a build with other golden verdicts worked on this catalogue.
  void begin_run(const RunInfo& run, const Goal& goal, Builds builds = Builds::same);
  /// One transaction: the units, their candidates and what else belongs to them, and the goal's
  /// end. UserError: failure if the file was removed meanwhile; see storage_failure.
  void commit(const std::vector<UnitRecord>& units);
  /// Of a splitting search: the scores of its levels, none where they are not known yet; what is
  /// done of populations under way, of a layout, without the results; and the result of one.
  std::vector<int> levels() const { return read_levels(*database_); }
  std::vector<PieceRow> pieces(const std::string& layout) const;
  std::string result_of(const PieceRow& piece) const;
  /// One transaction each: the levels, instead of what is done of finding them by this population;
  /// more pieces.
  void keep_levels(const std::vector<int>& scores, std::uint32_t level_finder);
  void keep_pieces(const std::vector<PieceRow>& pieces);
  /// One transaction: whole units of another catalogue of this campaign, with its runs. Before
  /// begin_run. UserError (bad_input) if the other one holds rows that no catalogue may.
  void take_over(SQLite::Database& other, const std::vector<DrawRange>& units);
  /// One transaction: a draw that was undecided, judged again; see UnitWriter.
  void settle(const UnitRecord& decided);
  /// One transaction: what was found of miscut copies. The draws that are no candidates here, of
  /// which nothing is kept: see write_yields.
  std::vector<std::uint64_t> keep(const std::vector<Yield>& yields,
                                  const std::string& commit_of_build);
  /// One transaction: certificates, each in the place of the one that was there. The draws that
  /// are no candidates here, of which nothing is kept.
  std::vector<std::uint64_t> keep(const std::vector<CertificateRecord>& certificates);
  /// The same of another catalogue, for candidates that both hold.
  void take_over_yields(SQLite::Database& other);
  /// The same of certificates, see copy_certificates: how many were not taken because they are not
  /// as they were made.
  std::uint64_t take_over_certificates(SQLite::Database& other);
  /// `end` says why, see catalogue.sql. Closes the file: nothing else may follow.
  void end_run(const std::string& end);
  /// Leaves one plain file: nothing else may follow.
  void close();
  /// Copies what is in the log into the file, as far as readers let it: who copies the file alone
  /// has that much. Waits for nobody.
  void fold_in();

  /// Where the goal ends as far as is known, see GoalEnd.
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
  WriterLock lock_;
  std::unique_ptr<SQLite::Database> database_;
  std::optional<WriteAheadLog> log_;
  std::optional<UnitWriter> writer_;
  Goal goal_;
  std::optional<GoalEnd> goal_end_;
  std::int64_t run_ = 0;
  CommitCost cost_;
};

/// Whether the catalogue there holds all that a run of this campaign to this goal would write, so
/// that there is nothing to write. Only reads; false where it cannot, too.
bool holds_all(const std::string& path, const Campaign& campaign, const Goal& goal);

}  // namespace misalign::schema
