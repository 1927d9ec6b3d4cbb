// The MPI calls that the program uses.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "search/ranks/messages.hpp"

namespace misalign::search {

/// The ranks that a launcher started, or this process alone: then MPI need not begin, which takes
/// longer than a short search and can fail on a machine where nothing else does.
class MpiSession {
 public:
  enum class Alone { without_mpi, with_mpi };
  explicit MpiSession(Alone alone = Alone::without_mpi);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }

  /// From rank 0 to all.
  int broadcast(int value) const;
  std::string broadcast(const std::string& text) const;
  /// On rank 0 everyone's text, in the order of the ranks; nothing elsewhere.
  std::vector<std::string> gather(const std::string& text) const;
  /// Returns once every rank has called it; sleeps meanwhile. False if that takes longer than so
  /// long after a request to leave.
  bool meet(double patience_s = std::numeric_limits<double>::infinity()) const;

  /// To rank 0: what was done of a job. UserError: see message_length.
  void send_result(const Bytes& result) const;
  /// On rank 0: the next result that has arrived; none if there is none.
  struct Arrived {
    int from;
    Bytes result;
  };
  std::optional<Arrived> receive_result() const;

  /// From rank 0: a job to work off; an empty one ends the worker.
  void send_job(int to, const Bytes& job) const;
  bool job_waiting() const;
  /// Sleeps until there is one.
  Bytes receive_job() const;

  /// Whether this MPI can carry signs of life, which want a thread of their own.
  bool has_beats() const { return beats_ != nullptr; }
  /// A sign of life; never waits.
  void send_beat(int to) const;
  /// From whom the next beat is that has arrived; none if there is none.
  std::optional<int> receive_beat() const;

  /// Ends every rank at once: only after a failure that leaves the others waiting.
  [[noreturn]] void abort(int exit_code) const;

 private:
  int rank_ = 0, ranks_ = 1;
  const bool has_begun_;
  struct Beats;  // a communicator of their own
  std::unique_ptr<Beats> beats_;
};

/// Sleeps that grow from 0 to 1 ms: a blocking MPI call would burn a core.
class Backoff {
 public:
  void reset() { microseconds_ = 0; }
  void wait();

 private:
  int microseconds_ = 0;
};

/// The rank that a launcher gave this process, before or without MPI; 0 if there was no launcher.
int launched_rank();
/// Whether mpirun or the like started this process. To be asked before MPI begins.
bool launched_by_mpi();

/// How many tasks the launcher of this process has started, by a variable of the environment that
/// it sets in each of them; nothing without one. A script within a larger allocation is no task.
struct LaunchedTasks {
  std::string launcher, variable;
  int count;
};
std::optional<LaunchedTasks> launched_tasks();

}  // namespace misalign::search
