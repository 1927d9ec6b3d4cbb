// Coordinates the ranks from rank 0, which hands out jobs, writes the catalogue, and computes too
// if ranks are few.
#pragma once

#include <functional>
#include <optional>

#include "search/ranks/heartbeat.hpp"
#include "search/ranks/rank_task.hpp"
#include "search/terminal/progress.hpp"

namespace misalign::search {

/// Largest number of ranks with which rank 0 does jobs itself: more would lose time waiting for it.
inline constexpr int kMostRanksWithOwnJobs = 64;

/// Approximate largest number of rows of one transaction. This bounds its memory, and a signal is
/// seen within seconds.
inline constexpr std::size_t kMostRows = 20000;

struct CoordinatorOptions {
  std::optional<double> max_time_s;
  ProgressStyle progress = ProgressStyle::plain;
  std::function<void()> tidy_up = {};  ///< called every half minute
};

enum class RunEnd {
  complete,  ///< all below the goal's end is done
  max_time,  ///< the run's wall time is over
  stopped,   ///< a signal requested it
  lost       ///< a rank is silent, see Heartbeat
};

const char* run_end_name(RunEnd end);

/// Runs the task until its goal or a stop, and ends the workers. Every job is committed as far as
/// it was done, except those of lost ranks, and of ranks that take longer than kPatience_s to
/// leave.
RunEnd run_coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, RankTask& task,
                       const CoordinatorOptions& options);

}  // namespace misalign::search
