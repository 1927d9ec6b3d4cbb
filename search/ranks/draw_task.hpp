// Makes plain draws: a job is a range of them, its result a unit of the ledger.
#pragma once

#include "schema/catalogue/catalogue.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/dispatcher.hpp"
#include "search/ranks/rank_task.hpp"

namespace misalign::search {

struct DrawTaskOptions {
  UnitSize unit_size;
  std::size_t unit_bytes = kMostUnit_bytes;  ///< size at which a unit ends early
};

class DrawTask final : public RankTask {
 public:
  /// All must outlive this object; the catalogue's run has begun already.
  DrawTask(DrawEvaluator& evaluator, schema::Catalogue& catalogue, const schema::Goal& goal,
           int ranks, const DrawTaskOptions& options);

  std::optional<Bytes> assign(int worker) override;
  bool has_job(int worker) const override { return dispatcher_.assigned(worker).has_value(); }
  bool take_back(int worker, const Bytes& result) override;
  bool compute_one_block() override;
  void hand_in_own() override;
  std::size_t rows_waiting() const override { return rows_; }
  void commit() override;
  void commit_all() override { commit(); }
  bool anything_open() const override { return dispatcher_.anything_open(); }
  bool complete() const override { return dispatcher_.complete(); }
  ProgressCounts counts() const override;

 private:
  void take_back(schema::UnitRecord unit);

  DrawEvaluator& evaluator_;
  schema::Catalogue& catalogue_;
  const DrawTaskOptions options_;
  const bool limited_;
  Dispatcher dispatcher_;
  schema::Standing standing_;
  std::optional<UnitWork> own_work_;
  std::vector<schema::UnitRecord> waiting_;
  std::size_t rows_ = 0;
  std::uint64_t draws_of_run_ = 0;
};

}  // namespace misalign::search
