#include "schema/catalogue/catalogue.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <chrono>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/certificate_table.hpp"
#include "schema/catalogue/sheets_once.hpp"
#include "schema/catalogue/unit_copier.hpp"

namespace misalign::schema {

std::vector<DrawRange> Catalogue::done() const { return units_done(*database_); }

Standing Catalogue::standing() const { return read_standing(*database_); }

std::vector<std::uint64_t> Catalogue::undecided() const {
  return draws_of(*database_, "undecided", {0, kEndOfDraws});
}

void Catalogue::begin_run(const RunInfo& run, const Goal& goal, Builds builds) {
  guarded(path_, [&] {
    if (builds == Builds::same) check_same_builds(run);
    goal_ = goal;
    const GoalEnd end = goal_end_of_rows(*database_, goal);
    const std::string configuration = stored_configuration(campaign_).dump();
    transact([&] {
      bound(*database_,
            "UPDATE campaign SET name = ?, configuration = ?, range_lo = ?, range_hi = ?, "
            "goal_draws = ?, goal_accepted = ?, goal_relative_error = ?, goal_end = ?",
            campaign_.name, configuration, goal.range.lo, goal.range.hi, goal.draws, goal.accepted,
            goal.relative_error, end.value())
          .exec();
      bound(*database_,
            "INSERT INTO run (started_at, host, ranks, version, \"commit\", compiler, flags, "
            "golden_verdicts, configuration, schema_version, metrics_version) VALUES "
            "(strftime('%Y-%m-%dT%H:%M:%fZ'), ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
            run.host, run.ranks, run.version, run.commit, run.compiler, run.flags,
            run.golden_verdicts, configuration, kSchemaVersion, solver::kMetricsVersion)
          .exec();
    });
    run_ = database_->getLastInsertRowid();
    goal_end_ = end;
    cost_ = {};
    log_->copy_into_file();
  });
}

void Catalogue::commit(const std::vector<UnitRecord>& units) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  guarded(path_, [&] {
    GoalEnd end = *goal_end_;
    transact([&] {
      end = *goal_end_;  // this may be the second attempt
      writer_->write(units, run_);
      keep_tables(units);
      for (const UnitRecord& unit : units) add_to_goal(unit, end);
      if (end.value() != goal_end_->value()) store_goal_end(end);
    });
    goal_end_ = std::move(end);
    log_->keep_small();
  });
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  ++cost_.commits;
  cost_.seconds += seconds;
  cost_.longest_s = std::max(cost_.longest_s, seconds);
}

// Stores the largest tables_deg of the units in their run.
void Catalogue::keep_tables(const std::vector<UnitRecord>& units) {
  double deg = 0;
  for (const UnitRecord& unit : units) deg = std::max(deg, unit.tables_deg);
  if (deg == 0) return;
  bound(*database_, "UPDATE run SET tables_deg = ?1 WHERE id = ?2 AND coalesce(tables_deg, 0) < ?1",
        deg, run_)
      .exec();
}

std::string Catalogue::result_of(const PieceRow& piece) const {
  return reading(*database_, [&] { return read_result(*database_, piece); });
}

std::vector<PieceRow> Catalogue::pieces(const std::string& layout) const {
  return reading(*database_, [&] { return read_pieces(*database_, layout); });
}

void Catalogue::keep_levels(const std::vector<int>& scores, std::uint32_t level_finder) {
  transact([&] {
    write_levels(*database_, scores, campaign_.sample_deg);
    drop_pieces(*database_, level_finder);
  });
}

void Catalogue::keep_pieces(const std::vector<PieceRow>& pieces) {
  transact([&] { write_pieces(*database_, pieces); });
}

void Catalogue::add_to_goal(const UnitRecord& unit, GoalEnd& end) const {
  if (!campaign_.search.splitting) {
    end.add(unit.range, unit.accepted_draws(), unit.undecided_draws());
  } else if (goal_.looks_at_results()) {
    const auto top = static_cast<std::uint32_t>(levels().size());
    end.add_population(unit.range, share_reaching(top, unit.levels));
  }
}

void Catalogue::take_over(SQLite::Database& other, const std::vector<DrawRange>& units) {
  transact([&] {
    UnitCopier copier(other, *database_, campaign_.search);
    copier.copy_runs();
    for (const DrawRange& unit : units) copier.copy(unit);
    if (!campaign_.search.splitting) return;
    take_over_levels(other);
    keep_each_sheet_once(*database_, campaign_, mechanism_, {0, kEndOfDraws});
  });
}

// Levels are a function of the campaign: if they differ, one of two builds is broken.
void Catalogue::take_over_levels(SQLite::Database& other) {
  const std::vector<int> ours = levels(), theirs = read_levels(other);
  if (ours.empty()) {
    write_levels(*database_, theirs, campaign_.sample_deg);
  } else if (!theirs.empty() && theirs != ours) {
    throw UserError(
        Cause::foreign,
        other.getFilename() +
            ": its levels are others than those of the catalogues before it (another build's "
            "level finder found them); join what one build has made, or name the levels in the "
            "campaign");
  }
}

std::vector<std::uint64_t> Catalogue::keep(const std::vector<Yield>& yields,
                                           const std::string& commit_of_build) {
  std::vector<std::uint64_t> no_candidates;
  transact([&] { no_candidates = write_yields(*database_, yields, commit_of_build); });
  return no_candidates;
}

std::vector<std::uint64_t> Catalogue::keep(const std::vector<CertificateRecord>& certificates) {
  std::vector<std::uint64_t> no_candidates;
  transact([&] { no_candidates = write_certificates(*database_, certificates); });
  return no_candidates;
}

void Catalogue::take_over_yields(SQLite::Database& other) {
  transact([&] { copy_yields(other, *database_); });
}

std::uint64_t Catalogue::take_over_certificates(SQLite::Database& other) {
  std::uint64_t faulty = 0;
  transact([&] { faulty = copy_certificates(other, *database_, campaign_, mechanism_); });
  return faulty;
}

void Catalogue::settle(const UnitRecord& decided) {
  transact([&] {
    writer_->settle(decided);
    goal_end_ = goal_end_of_rows(*database_, goal_);
    store_goal_end(*goal_end_);
  });
}

// Runs one transaction on the file, which must still be in its place. If the disk is full, the log
// is folded into the file to free its space, and the transaction is tried once more.
template <class Work>
void Catalogue::transact(const Work& work) {
  lock_.check_file_is_there();
  const auto once = [&] {
    SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
    work();
    transaction.commit();
  };
  guarded(path_, [&] {
    try {
      once();
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_FULL || storage_ == Storage::network) throw;
      log_->fold_in();
      once();
    }
  });
  lock_.check_file_is_there();
}

void Catalogue::store_goal_end(const GoalEnd& end) {
  bound(*database_, "UPDATE campaign SET goal_end = ?", end.value()).exec();
}

void Catalogue::end_run(const std::string& end) {
  transact([&] {
    bound(*database_,
          "UPDATE run SET ended_at = strftime('%Y-%m-%dT%H:%M:%fZ'), end = ?, commits = ?, "
          "commit_s = ?, longest_commit_s = ? WHERE id = ?",
          end, cost_.commits, cost_.seconds, cost_.longest_s, run_)
        .exec();
  });
  close();
}

void Catalogue::fold_in() { log_->copy_into_file(); }

}  // namespace misalign::schema
