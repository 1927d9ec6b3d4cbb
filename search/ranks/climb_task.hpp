// Runs a splitting search: its jobs are pieces of populations, which are units of the ledger.
#pragma once

#include "schema/catalogue/catalogue.hpp"
#include "search/ranks/climb_dispatcher.hpp"
#include "search/ranks/rank_task.hpp"
#include "search/splitting/climber.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {

class ClimbTask final : public RankTask {
 public:
  /// All must outlive this object; the catalogue's run has begun already. Resumes populations under
  /// way from the catalogue.
  ClimbTask(Climber& climber, schema::Catalogue& catalogue, const schema::Goal& goal, int ranks);

  std::optional<Bytes> assign(int worker) override;
  bool has_job(int worker) const override { return dispatcher_.has_job(worker); }
  bool take_back(int worker, const Bytes& result) override;
  bool compute_one_block() override;
  void hand_in_own() override;
  std::size_t rows_waiting() const override { return rows_; }
  void commit() override;
  void commit_all() override;
  bool anything_open() const override { return dispatcher_.anything_open(); }
  bool complete() const override { return dispatcher_.complete(); }
  ProgressCounts counts() const override;

 private:
  void restore();
  void take_back(int worker, PieceResult result);
  void write_levels();
  void commit_pieces();
  schema::UnitRecord unit_of(PopulationRecord record) const;

  Climber& climber_;
  schema::Catalogue& catalogue_;
  const schema::Splitting& splitting_;
  const bool limited_;
  ClimbDispatcher dispatcher_;
  schema::Standing standing_;
  std::optional<PieceWork> own_work_;
  std::vector<schema::PieceRow> waiting_;
  std::size_t rows_ = 0;
  Stopwatch since_commit_;
  std::uint64_t populations_of_run_ = 0;
};

}  // namespace misalign::search
