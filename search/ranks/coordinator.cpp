#include "search/ranks/coordinator.hpp"

#include <algorithm>
#include <utility>

#include "search/ranks/stop_signal.hpp"

namespace misalign::search {
namespace {

class Coordinator {
 public:
  Coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, DrawEvaluator& evaluator,
              schema::Catalogue& catalogue, const schema::Goal& goal,
              const CoordinatorOptions& options)
      : mpi_(mpi),
        heartbeat_(heartbeat),
        evaluator_(evaluator),
        catalogue_(catalogue),
        options_(options),
        limited_(goal.planned_end() < schema::kEndOfDraws),
        dispatcher_({{goal.range.lo, catalogue.goal_end()}, catalogue.done()}, mpi.ranks(),
                    options.unit_size),
        progress_(options.progress),
        standing_(catalogue.standing()) {}

  RunEnd run() {
    for (int rank = 1; rank < mpi_.ranks(); ++rank) assign(rank);
    std::optional<RunEnd> stop;
    while (!stop && !dispatcher_.complete()) {
      const bool computed = compute_one_block();
      const bool received = receive_all();
      if (computed || received) {
        backoff_.reset();
      } else {
        backoff_.wait();
      }
      if (progress_.due()) progress_.show(counts());
      if (status_wish()) progress_.show_status(counts());
      stop = reason_to_stop();
    }
    if (own_work_) commit_own_work();
    end_workers();
    progress_.finish(counts());
    if (heartbeat_.lost()) return RunEnd::lost;
    return dispatcher_.complete() ? RunEnd::complete : *stop;
  }

 private:
  std::optional<RunEnd> reason_to_stop() const {
    if (heartbeat_.lost()) return RunEnd::lost;
    if (stop_wish() != StopWish::none || worker_was_stopped_) return RunEnd::stopped;
    if (options_.max_time_s && progress_.seconds() >= *options_.max_time_s) return RunEnd::max_time;
    return std::nullopt;
  }

  void assign(int rank) {
    if (const auto range = dispatcher_.assign(rank)) {
      mpi_.send_range(rank, *range);
    } else {
      idle_.push_back(rank);
    }
  }

  bool compute_one_block() {
    if (mpi_.ranks() > kMostRanksWithOwnDraws) return false;
    if (!own_work_) {
      if (const auto range = dispatcher_.assign(0))
        own_work_.emplace(evaluator_, *range, schema::FaultSampleRule(), options_.unit_bytes);
    }
    if (!own_work_) return false;
    own_work_->run_next_block();
    if (own_work_->finished() || own_work_->is_full()) commit_own_work();
    return true;
  }

  void commit_own_work() {
    schema::UnitRecord unit = own_work_->take();
    own_work_.reset();
    hand_on(unit);
    commit({std::move(unit)});
  }

  // What has arrived is one transaction. Whoever sent it has its next range before that is written.
  bool receive_all() {
    std::vector<schema::UnitRecord> units;
    for (std::size_t rows = 0; rows < kMostRows;) {
      std::optional<SentUnit> sent = mpi_.receive_unit();
      if (!sent) break;
      if (sent->was_stopped) worker_was_stopped_ = true;
      schema::UnitRecord& unit = sent->unit;
      hand_on(unit);
      rows += 1 + unit.candidates.size() + unit.fault_sample.size();
      units.push_back(std::move(unit));
    }
    if (units.empty()) return false;
    commit(std::move(units));
    return true;
  }

  // What its rank has not done of the range is open again, and the rank gets another one.
  void hand_on(const schema::UnitRecord& unit) {
    dispatcher_.settle(unit.worker, unit.range.hi, unit.seconds);
    if (unit.worker > 0) idle_.push_back(unit.worker);
    if (reason_to_stop() || !dispatcher_.anything_open()) return;
    for (const int rank : std::exchange(idle_, {})) assign(rank);
  }

  void commit(std::vector<schema::UnitRecord> units) {
    std::erase_if(units, [](const schema::UnitRecord& unit) { return unit.range.size() == 0; });
    for (const schema::UnitRecord& unit : units) {
      draws_of_run_ += unit.range.size();
      standing_.add(unit);
    }
    if (!units.empty()) catalogue_.commit(units);
    dispatcher_.cut(catalogue_.goal_end());
  }

  // Every worker gets one empty range: the idle leave, the others send what they have and leave.
  void end_workers() {
    if (heartbeat_.lost()) return;
    for (int rank = 1; rank < mpi_.ranks(); ++rank) mpi_.send_range(rank, {0, 0});
    for (int rank = 1; rank < mpi_.ranks(); ++rank) {
      while (dispatcher_.assigned(rank) && !heartbeat_.lost()) {
        if (!receive_all()) backoff_.wait();
      }
    }
  }

  // With what rank 0 has under way, so that the numbers move although units take seconds.
  ProgressCounts counts() const {
    ProgressCounts counts{standing_, draws_of_run_, dispatcher_.draws_left(), limited_,
                          options_.max_time_s};
    if (!own_work_) return counts;
    const std::uint64_t draws = own_work_->so_far().range.size();
    counts.standing.add(own_work_->so_far());
    counts.draws_of_run += draws;
    counts.draws_left -= std::min(draws, counts.draws_left);  // the goal may have been cut
    return counts;
  }

  const MpiSession& mpi_;
  const Heartbeat& heartbeat_;
  DrawEvaluator& evaluator_;
  schema::Catalogue& catalogue_;
  const CoordinatorOptions& options_;
  const bool limited_;
  Dispatcher dispatcher_;
  Progress progress_;
  schema::Standing standing_;
  Backoff backoff_;
  std::vector<int> idle_;  // workers without a range
  std::optional<UnitWork> own_work_;
  bool worker_was_stopped_ = false;  // one of them saw a signal that rank 0 did not
  std::uint64_t draws_of_run_ = 0;
};

}  // namespace

const char* run_end_name(RunEnd end) {
  switch (end) {
    case RunEnd::complete:
      return "complete";
    case RunEnd::max_time:
      return "max_time";
    case RunEnd::stopped:
      return "stopped";
    case RunEnd::lost:
      return "lost";
  }
  return "";
}

RunEnd run_coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, DrawEvaluator& evaluator,
                       schema::Catalogue& catalogue, const schema::Goal& goal,
                       const CoordinatorOptions& options) {
  return Coordinator(mpi, heartbeat, evaluator, catalogue, goal, options).run();
}

}  // namespace misalign::search
