// The loop of ranks above 0: do jobs until an empty one comes.
#pragma once

#include "search/ranks/mpi_session.hpp"
#include "search/ranks/stop_signal.hpp"

namespace misalign::search {

/// A job under way is cut short, and sent as far as it is done, when a signal asks to stop, rank 0
/// has already sent the next one, or its results take all that they may. `begin` makes a job's work
/// from its bytes (UnitWork, PieceWork), `end` a result's bytes from the work, and from whether a
/// signal stopped it.
template <class Begin, class End>
void run_worker(const MpiSession& mpi, const Begin& begin, const End& end) {
  for (;;) {
    const Bytes job = mpi.receive_job();
    if (job.empty()) return;
    auto work = begin(job);
    while (!work.finished() && !work.is_full() && stop_request() == StopRequest::none &&
           !mpi.job_waiting()) {
      work.run_next_block();
    }
    mpi.send_result(end(work, !work.finished() && !work.is_full()));
  }
}

}  // namespace misalign::search
