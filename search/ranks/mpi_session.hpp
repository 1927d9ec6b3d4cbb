// Wraps the MPI calls that the program uses.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "search/ranks/messages.hpp"

namespace misalign::search {

/// The ranks that a launcher started, or this process alone. Alone, MPI is not initialised: that
/// takes longer than a short search, and can fail on a machine where all else works.
class MpiSession {
 public:
  enum class Alone { without_mpi, with_mpi };
  explicit MpiSession(Alone alone = Alone::without_mpi);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  /// Sends rank 0's value to all ranks.
  int broadcast(int value) const;
  std::string broadcast(const std::string& text) const;
  /// Returns on rank 0 the texts of all ranks, in their order; elsewhere nothing.
  std::vector<std::string> gather(const std::string& text) const;
  /// Returns once every rank has called it; sleeps meanwhile. False if that takes longer than
  /// `patience_s` after a request to leave.
  bool meet(double patience_s = std::numeric_limits<double>::infinity()) const;

  /// Sends a job's result to rank 0. UserError: see message_length.
  void send_result(const Bytes& result) const;
  /// A result that has arrived on rank 0; receive_result() returns the next one, or none.
  struct Arrived {
    int from;
    Bytes result;
  };
  std::optional<Arrived> receive_result() const;

  /// Sends a job from rank 0; an empty one ends the worker.
  void send_job(int to, const Bytes& job) const;
  bool job_waiting() const;
  /// Waits for a job, sleeping.
  Bytes receive_job() const;

  /// Returns whether this MPI supports heartbeats, which need threads.
  bool has_beats() const { return beats_ != nullptr; }
  /// Sends a heartbeat; never waits.
  void send_beat(int to) const;
  /// Returns the sender of the next beat that has arrived; none without one.
  std::optional<int> receive_beat() const;

  /// Ends every rank at once, after a failure that leaves the others waiting.
  [[noreturn]] void abort(int exit_code) const;

 private:
  int rank_ = 0, ranks_ = 1;
  const bool has_begun_;
  struct Beats;  // a communicator of their own
  std::unique_ptr<Beats> beats_;
};

/// Sleeps for 0 to 1 ms, ever longer: a blocking MPI call would keep a core busy.
class Backoff {
 public:
  void reset() { microseconds_ = 0; }
  void wait();

 private:
  int microseconds_ = 0;
};

/// Returns the launcher's rank of this process, before or without MPI; 0 without a launcher.
int launched_rank();
/// Returns whether mpirun or the like started this process. Call it before MPI_Init.
bool launched_by_mpi();

/// Number of tasks that this process's launcher has started, from an environment variable that it
/// sets in each. A script within a larger allocation is no task.
struct LaunchedTasks {
  std::string launcher, variable;
  int count;
};
std::optional<LaunchedTasks> launched_tasks();

}  // namespace misalign::search
