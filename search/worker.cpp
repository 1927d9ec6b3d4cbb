#include "search/worker.hpp"

#include "search/stop_signal.hpp"

namespace misalign::search {

void run_worker(const MpiSession& mpi, Trial& trial) {
  for (;;) {
    const schema::DrawRange range = mpi.receive_range();
    if (range.size() == 0) return;
    UnitWork work(trial, range);
    while (!work.finished() && stop_wish() == StopWish::none && !mpi.range_waiting()) {
      work.run_next_block();
    }
    mpi.send_unit(work.take());
  }
}

}  // namespace misalign::search
