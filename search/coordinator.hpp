// Rank 0: hands out ranges, is the only writer, and computes too.
#pragma once

#include <optional>

#include "search/ledger.hpp"
#include "search/mpi_session.hpp"
#include "search/progress.hpp"
#include "search/trial.hpp"

namespace misalign::search {

struct CoordinatorOptions {
  std::optional<std::uint64_t> unit_draws;  ///< instead of units of about unit_s
  double unit_s = 5;
  std::optional<double> max_time_s;
  ProgressStyle progress = ProgressStyle::plain;
};

enum class RunEnd {
  complete,  ///< nothing is left below the goal's end
  max_time,  ///< the run's wall time is over
  stopped    ///< a signal asked for it
};

const char* run_end_name(RunEnd end);

/// Runs the campaign until its goal or a stop; every unit that was begun is committed as far as it
/// was done. Ends the workers. The catalogue's run has begun already.
RunEnd run_coordinator(const MpiSession& mpi, Trial& trial, schema::Catalogue& catalogue,
                       const schema::Goal& goal, const CoordinatorOptions& options);

}  // namespace misalign::search
