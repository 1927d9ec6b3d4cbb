#include "search/coordinator.hpp"

#include "search/stop_signal.hpp"

namespace misalign::search {
namespace {

class Coordinator {
 public:
  Coordinator(const MpiSession& mpi, Trial& trial, schema::Catalogue& catalogue,
              const schema::Goal& goal, const CoordinatorOptions& options)
      : mpi_(mpi),
        trial_(trial),
        catalogue_(catalogue),
        options_(options),
        limited_(goal.planned_end() < schema::kEndOfDraws),
        ledger_({goal.range.lo, catalogue.goal_end()}, catalogue.done()),
        progress_(options.progress),
        assigned_(mpi.ranks()),
        draws_per_s_(mpi.ranks(), 0) {}

  RunEnd run() {
    std::optional<RunEnd> stop;
    while (!stop && !ledger_.complete()) {
      for (int rank = 1; rank < mpi_.ranks(); ++rank) {
        if (!assigned_[rank]) assign(rank);
      }
      const bool computed = compute_one_block();
      const bool received = receive_all();
      if (computed || received) {
        backoff_.reset();
      } else {
        backoff_.wait();
      }
      progress_.show(counts());
      stop = reason_to_stop();
    }
    end_workers();
    if (own_work_) settle(0, own_work_->take());
    progress_.show(counts(), true);
    return ledger_.complete() ? RunEnd::complete : *stop;
  }

 private:
  std::optional<RunEnd> reason_to_stop() const {
    if (stop_signal_seen() || worker_was_stopped_) return RunEnd::stopped;
    if (options_.max_time_s && progress_.seconds() >= *options_.max_time_s) return RunEnd::max_time;
    return std::nullopt;
  }

  std::optional<DrawRange> take_range(int rank) {
    const std::uint64_t draws = options_.unit_draws.value_or(
        unit_draws(draws_per_s_[rank], options_.unit_s, ledger_.open_draws(), mpi_.ranks()));
    assigned_[rank] = ledger_.take(draws);
    return assigned_[rank];
  }

  void assign(int rank) {
    if (const auto range = take_range(rank)) mpi_.send_range(rank, *range);
  }

  bool compute_one_block() {
    if (!own_work_) {
      if (const auto range = take_range(0)) own_work_.emplace(trial_, *range);
    }
    if (!own_work_) return false;
    own_work_->run_next_block();
    if (own_work_->finished()) {
      const schema::UnitRecord unit = own_work_->take();
      own_work_.reset();
      settle(0, unit);
    }
    return true;
  }

  bool receive_all() {
    bool any = false;
    while (const auto arrival = mpi_.receive_unit()) {
      settle(arrival->from, arrival->unit);
      any = true;
    }
    return any;
  }

  // Commits what a rank has done of its range; what it has not done is open again.
  void settle(int rank, const schema::UnitRecord& unit) {
    if (unit.range.size() > 0) {
      catalogue_.commit(unit, rank);
      ledger_.cut(catalogue_.goal_end());
      draws_ += unit.range.size();
      accepted_ += unit.accepted;
      if (unit.seconds > 0) {
        draws_per_s_[rank] = static_cast<double>(unit.range.size()) / unit.seconds;
      }
    }
    if (rank > 0 && unit.range.hi < assigned_[rank]->hi) worker_was_stopped_ = true;
    ledger_.finish(*assigned_[rank], unit.range.hi);
    assigned_[rank].reset();
  }

  // Every worker gets one empty range: the idle leave, the others send what they have and leave.
  void end_workers() {
    for (int rank = 1; rank < mpi_.ranks(); ++rank) mpi_.send_range(rank, {0, 0});
    for (int rank = 1; rank < mpi_.ranks(); ++rank) {
      while (assigned_[rank]) {
        if (!receive_all()) backoff_.wait();
      }
    }
  }

  ProgressCounts counts() const {
    return {draws_, accepted_, ledger_.open_draws() + ledger_.draws_given_out(), limited_};
  }

  const MpiSession& mpi_;
  Trial& trial_;
  schema::Catalogue& catalogue_;
  const CoordinatorOptions& options_;
  const bool limited_;
  Ledger ledger_;
  Progress progress_;
  Backoff backoff_;
  std::vector<std::optional<DrawRange>> assigned_;  // per rank
  std::vector<double> draws_per_s_;                 // per rank, of its last unit
  std::optional<UnitWork> own_work_;
  bool worker_was_stopped_ = false;  // one of them saw a signal that rank 0 did not
  std::uint64_t draws_ = 0, accepted_ = 0;
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
  }
  return "";
}

RunEnd run_coordinator(const MpiSession& mpi, Trial& trial, schema::Catalogue& catalogue,
                       const schema::Goal& goal, const CoordinatorOptions& options) {
  return Coordinator(mpi, trial, catalogue, goal, options).run();
}

}  // namespace misalign::search
