// Ends a process that was asked to leave if its main thread does not leave in time.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace misalign::search {

/// Time that a main thread may take to leave by itself. mpirun kills its ranks one second after a
/// request to stop; the rest of that second is for committing, folding in the log and the message.
/// Rank 0 releases the other ranks, or they leave soon after.
inline constexpr double kPatience_s = 0.35, kPatienceAlone_s = 2, kRelease_s = 3;

/// Marks a time in which the main thread computes or waits, and touches nothing that a Departure
/// touches. A main thread that was left does not continue.
class MayBeLeft {
 public:
  MayBeLeft();
  ~MayBeLeft();
  MayBeLeft(const MayBeLeft&) = delete;
  MayBeLeft& operator=(const MayBeLeft&) = delete;
};

/// Places where the main thread can be left.
enum class LeftFrom {
  anywhere,
  safe_places  ///< while it MayBeLeft
};

/// A thread that waits for a request to leave. Once the patience is over and the main thread can be
/// left, it calls `leave` and ends the process with the exit code that it returns.
class Departure {
 public:
  using Leave = std::function<int()>;
  Departure(double patience_s, LeftFrom from, Leave leave);

  /// The main thread has reported the end of the run; no other message is needed.
  void told() { told_ = true; }

 private:
  void wait(const std::stop_token& stop);
  [[noreturn]] void depart() const;

  const double patience_s_;
  const LeftFrom from_;
  const Leave leave_;
  std::atomic<bool> told_ = false;
  std::jthread thread_;  // the last: it ends first
};

}  // namespace misalign::search
