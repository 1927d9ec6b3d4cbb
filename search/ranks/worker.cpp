#include "search/ranks/worker.hpp"

#include "search/ranks/stop_signal.hpp"

namespace misalign::search {

void run_worker(const MpiSession& mpi, DrawEvaluator& evaluator, std::size_t most_bytes) {
  for (;;) {
    const schema::DrawRange range = mpi.receive_range();
    if (range.size() == 0) return;
    UnitWork work(evaluator, range, schema::FaultSampleRule(), most_bytes);
    while (!work.finished() && !work.is_full() && stop_wish() == StopWish::none &&
           !mpi.range_waiting()) {
      work.run_next_block();
    }
    const bool was_stopped = !work.finished() && !work.is_full();
    mpi.send_unit({work.take(), was_stopped});
  }
}

}  // namespace misalign::search
