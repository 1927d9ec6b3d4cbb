// Ranks above 0: compute ranges of draws until an empty one comes.
#pragma once

#include "search/draws/draw_evaluator.hpp"
#include "search/ranks/mpi_session.hpp"

namespace misalign::search {

/// A unit under way is cut short, and sent as far as it is done, when a signal asks to stop, rank 0
/// has already sent the next range, or its results take `most_bytes`.
void run_worker(const MpiSession& mpi, DrawEvaluator& evaluator, std::size_t most_bytes);

}  // namespace misalign::search
