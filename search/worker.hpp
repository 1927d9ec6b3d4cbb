// Ranks above 0: work off ranges until an empty one comes.
#pragma once

#include "search/mpi_session.hpp"
#include "search/trial.hpp"

namespace misalign::search {

/// A unit under way is cut short, and sent as far as it is done, when a signal asks to stop or rank
/// 0 has already sent the next range.
void run_worker(const MpiSession& mpi, Trial& trial);

}  // namespace misalign::search
