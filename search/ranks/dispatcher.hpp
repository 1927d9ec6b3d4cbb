// Assigns draws to ranks: a pure state machine, without clock, file or message.
#pragma once

#include "search/draws/ledger.hpp"

namespace misalign::search {

struct UnitSize {
  /// Every unit has so many draws, instead of being made by time.
  std::optional<std::uint64_t> draws;
  /// How long a unit takes at most: what a kill can cost each rank. 0: see unit_seconds.
  double seconds = 0;
};

/// 5 s, and longer for so many workers that their units would come faster than 200 a second.
double unit_seconds(int workers);

/// How many draws a unit has on a worker that makes `draws_per_s` (0: not known yet): a unit of
/// `unit_s`, and towards the end smaller ones, so that all `workers` end together; none below a
/// twentieth of that while there is more, so that they do not come too fast for rank 0.
std::uint64_t unit_draws(double draws_per_s, double unit_s, std::uint64_t open_draws, int workers);

class Dispatcher {
 public:
  Dispatcher(Ledger ledger, int workers, const UnitSize& size);

  /// A range for a worker that has none; nothing if none is open.
  std::optional<DrawRange> assign(int worker);
  /// The worker has done its range up to `done_to` in so many seconds; the rest is open again.
  void finish(int worker, std::uint64_t done_to, double seconds);
  /// The goal ends here now, see Ledger::cut.
  void cut(std::uint64_t end) { ledger_.cut(end); }

  const std::optional<DrawRange>& assigned(int worker) const { return workers_[worker].assigned; }
  bool complete() const { return ledger_.complete(); }
  bool anything_open() const { return ledger_.open_draws() > 0; }
  /// Draws that are not done: open or given out.
  std::uint64_t draws_left() const { return ledger_.open_draws() + ledger_.draws_given_out(); }

 private:
  struct Worker {
    std::optional<DrawRange> assigned;
    double draws_per_s = 0;  // of its last unit
  };
  Ledger ledger_;
  UnitSize size_;
  std::vector<Worker> workers_;
};

}  // namespace misalign::search
