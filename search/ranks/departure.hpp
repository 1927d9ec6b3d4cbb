// Ends a process that was asked to leave where its main thread does not come to it in time.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace misalign::search {

/// How long a main thread may take to leave by itself. Under mpirun, which kills its ranks a second
/// after it was asked to stop, the rest of that second is for committing, folding in the log and
/// the sentence, on a busy machine too. Other ranks are let go by rank 0, or leave soon after.
inline constexpr double kPatience_s = 0.35, kPatienceAlone_s = 2, kRelease_s = 3;

/// While one of these lives, the main thread touches nothing that a Departure touches: it computes
/// or waits. Once it was left it goes no farther.
class MayBeLeft {
 public:
  MayBeLeft();
  ~MayBeLeft();
  MayBeLeft(const MayBeLeft&) = delete;
  MayBeLeft& operator=(const MayBeLeft&) = delete;
};

/// From where the main thread is left.
enum class LeftFrom {
  anywhere,
  safe_places  ///< where it MayBeLeft
};

/// A thread that waits for a request to leave. Once the patience is over and the main thread can be
/// left, it calls `leave` and ends the process with the exit code that it returns.
class Departure {
 public:
  using Leave = std::function<int()>;
  Departure(double patience_s, LeftFrom from, Leave leave);

  /// The main thread has told how the run ended: nobody else needs to.
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
