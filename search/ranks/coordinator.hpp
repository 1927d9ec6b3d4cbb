// Rank 0: hands out ranges of draws, alone writes the catalogue, and computes too if ranks are few.
#pragma once

#include <optional>

#include "schema/catalogue/catalogue.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/dispatcher.hpp"
#include "search/ranks/heartbeat.hpp"
#include "search/terminal/progress.hpp"

namespace misalign::search {

/// With more ranks than this rank 0 makes no draws of its own: while it does, others wait for their
/// next range for longer than its draws are worth.
inline constexpr int kMostRanksWithOwnDraws = 64;

/// Of one transaction, roughly; what more has arrived waits for the next. So its memory is bounded,
/// and a signal is seen within seconds.
inline constexpr std::size_t kMostRows = 20000;

struct CoordinatorOptions {
  UnitSize unit_size;
  std::size_t unit_bytes = kMostUnit_bytes;  ///< at which a unit ends early
  std::optional<double> max_time_s;
  ProgressStyle progress = ProgressStyle::plain;
};

enum class RunEnd {
  complete,  ///< nothing is left below the goal's end
  max_time,  ///< the run's wall time is over
  stopped,   ///< a signal asked for it
  lost       ///< a rank is silent, see Heartbeat
};

const char* run_end_name(RunEnd end);

/// Runs the campaign until its goal or a stop; every unit that was begun is committed as far as it
/// was done, but for those of lost ranks. Ends the workers. The catalogue's run has begun already.
RunEnd run_coordinator(const MpiSession& mpi, const Heartbeat& heartbeat, DrawEvaluator& evaluator,
                       schema::Catalogue& catalogue, const schema::Goal& goal,
                       const CoordinatorOptions& options);

}  // namespace misalign::search
