// Assigns draws to ranks: a pure state machine, without clock, file or message.
#pragma once

#include "search/draws/ledger.hpp"

namespace misalign::search {

struct UnitSize {
  /// Number of draws of every unit; null for units made by time.
  std::optional<std::uint64_t> draws;
  /// Largest duration of a unit, which a kill can cost each rank. 0: see unit_seconds.
  double seconds = 0;
};

/// Returns 5 s, and more with workers whose units would arrive faster than 200 a second.
double unit_seconds(int workers);

/// Returns the draws of a unit for a worker that makes `draws_per_s` (0: not known yet). Units last
/// `unit_s`, and less towards the end, so that all `workers` end together; but no less than a
/// twentieth, so that they do not arrive too fast for rank 0.
std::uint64_t unit_draws(double draws_per_s, double unit_s, std::uint64_t open_draws, int workers);

class Dispatcher {
 public:
  Dispatcher(Ledger ledger, int workers, const UnitSize& size);

  /// Gives a range to a worker that has none; nothing if none is open.
  std::optional<DrawRange> assign(int worker);
  /// Takes back the worker's range, done up to `done_to` in `seconds`; the rest is open again.
  void finish(int worker, std::uint64_t done_to, double seconds);
  /// Ends the goal at `end`, see Ledger::cut.
  void cut(std::uint64_t end) { ledger_.cut(end); }

  const std::optional<DrawRange>& assigned(int worker) const { return workers_[worker].assigned; }
  bool complete() const { return ledger_.complete(); }
  bool anything_open() const { return ledger_.open_draws() > 0; }
  /// Counts draws that are not done: open or given out.
  std::uint64_t draws_left() const { return ledger_.open_draws() + ledger_.draws_given_out(); }

 private:
  struct Worker {
    std::optional<DrawRange> assigned;
    double draws_per_s = 0;  // speed of its last unit
  };
  Ledger ledger_;
  UnitSize size_;
  std::vector<Worker> workers_;
};

}  // namespace misalign::search
