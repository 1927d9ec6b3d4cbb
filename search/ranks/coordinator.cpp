#include "search/ranks/coordinator.hpp"

#include <algorithm>
#include <utility>

#include "search/ranks/departure.hpp"
#include "search/ranks/stop_signal.hpp"
#include "search/terminal/stopwatch.hpp"

namespace misalign::search {
namespace {

// Blocks of jobs are shorter, so that the log is folded in at least once a minute.
constexpr double kTidyEvery_s = 30;

class Coordinator {
 public:
  Coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, RankTask& task,
              const CoordinatorOptions& options)
      : mpi_(mpi),
        heartbeat_(heartbeat),
        task_(task),
        options_(options),
        progress_(options.progress) {}

  RunEnd run() {
    for (int rank = 1; rank < mpi_.ranks(); ++rank) assign(rank);
    std::optional<RunEnd> stop = reason_to_stop();
    while (!stop && !task_.complete()) {
      const bool computed = compute_one_block();
      const bool received = receive_all();
      if (computed || received) {
        backoff_.reset();
      } else {
        backoff_.wait();
      }
      if (progress_.due()) progress_.show(counts());
      if (status_request()) progress_.show_status(counts());
      tidy_up();
      stop = reason_to_stop();
    }
    tell_workers();
    task_.hand_in_own();
    task_.commit();
    wait_for_workers();
    task_.commit_all();
    progress_.finish(counts());
    if (heartbeat_.lost()) return RunEnd::lost;
    return task_.complete() ? RunEnd::complete : *stop;
  }

 private:
  std::optional<RunEnd> reason_to_stop() const {
    if (heartbeat_.lost()) return RunEnd::lost;
    if (stop_request() != StopRequest::none || worker_was_stopped_) return RunEnd::stopped;
    if (options_.max_time_s && progress_.seconds() >= *options_.max_time_s) return RunEnd::max_time;
    return std::nullopt;
  }

  void assign(int rank) {
    if (const auto job = task_.assign(rank)) {
      mpi_.send_job(rank, *job);
    } else {
      idle_.push_back(rank);
    }
  }

  bool compute_one_block() {
    if (mpi_.ranks() > kMostRanksWithOwnJobs || !task_.compute_one_block()) return false;
    if (task_.rows_waiting() > 0) {
      employ_idle();
      task_.commit();
    }
    return true;
  }

  // Writes all arrived results in one transaction. Their senders get their next jobs first.
  bool receive_all() {
    bool received = false;
    while (task_.rows_waiting() < kMostRows) {
      const auto arrived = mpi_.receive_result();
      if (!arrived) break;
      received = true;
      if (task_.take_back(arrived->from, arrived->result)) worker_was_stopped_ = true;
      idle_.push_back(arrived->from);
      employ_idle();
    }
    if (received) task_.commit();
    return received;
  }

  void employ_idle() {
    if (reason_to_stop() || !task_.anything_open()) return;
    for (const int rank : std::exchange(idle_, {})) assign(rank);
  }

  // Every worker gets one empty job: the idle leave, the others send what they have and leave.
  void tell_workers() const {
    if (heartbeat_.lost()) return;
    for (int rank = 1; rank < mpi_.ranks(); ++rank) mpi_.send_job(rank, {});
  }

  // Results that arrive after the patience is over are lost; a later run computes them again.
  void wait_for_workers() {
    const auto is_waited_for = [&](int rank) {
      return task_.has_job(rank) && !heartbeat_.lost() && seconds_since_leave() < kPatience_s;
    };
    for (int rank = 1; rank < mpi_.ranks(); ++rank) {
      while (is_waited_for(rank)) {
        if (!receive_all()) backoff_.wait();
      }
    }
  }

  void tidy_up() {
    if (!options_.tidy_up || since_tidy_.seconds() < kTidyEvery_s) return;
    options_.tidy_up();
    since_tidy_ = Stopwatch();
  }

  ProgressCounts counts() const {
    ProgressCounts counts = task_.counts();
    counts.max_time_s = options_.max_time_s;
    return counts;
  }

  const MpiSession& mpi_;
  const Heartbeat& heartbeat_;
  RankTask& task_;
  const CoordinatorOptions& options_;
  Progress progress_;
  Backoff backoff_;
  Stopwatch since_tidy_;
  std::vector<int> idle_;            // workers without a job
  bool worker_was_stopped_ = false;  // by a signal that rank 0 did not get
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

RunEnd run_coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, RankTask& task,
                       const CoordinatorOptions& options) {
  return Coordinator(mpi, heartbeat, task, options).run();
}

}  // namespace misalign::search
