// Rank 0: hands out jobs, alone writes the catalogue, and computes too if ranks are few.
#pragma once

#include <functional>
#include <optional>

#include "search/ranks/heartbeat.hpp"
#include "search/ranks/rank_task.hpp"
#include "search/terminal/progress.hpp"

namespace misalign::search {

/// With more ranks than this rank 0 does no jobs of its own: while it does, others wait for their
/// next one for longer than its own are worth.
inline constexpr int kMostRanksWithOwnJobs = 64;

/// Of one transaction, roughly; what more has arrived waits for the next. So its memory is bounded,
/// and a signal is seen within seconds.
inline constexpr std::size_t kMostRows = 20000;

struct CoordinatorOptions {
  std::optional<double> max_time_s;
  ProgressStyle progress = ProgressStyle::plain;
  std::function<void()> tidy_up = {};  ///< is called every half minute
};

enum class RunEnd {
  complete,  ///< nothing is left below the goal's end
  max_time,  ///< the run's wall time is over
  stopped,   ///< a signal asked for it
  lost       ///< a rank is silent, see Heartbeat
};

const char* run_end_name(RunEnd end);

/// Runs the task until its goal or a stop; every job that was begun is committed as far as it was
/// done, but for those of lost ranks, and of ranks that take longer than kPatience_s to leave. Ends
/// the workers.
RunEnd run_coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, RankTask& task,
                       const CoordinatorOptions& options);

}  // namespace misalign::search
