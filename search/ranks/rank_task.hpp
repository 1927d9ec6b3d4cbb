// Defines the task that the ranks share, as the coordinator sees it: jobs, results, and their
// commits.
#pragma once

#include <optional>

#include "search/ranks/messages.hpp"
#include "search/terminal/progress_text.hpp"

namespace misalign::search {

class RankTask {
 public:
  virtual ~RankTask() = default;

  /// Gives a job to a worker that has none; nothing if none is open.
  virtual std::optional<Bytes> assign(int worker) = 0;
  virtual bool has_job(int worker) const = 0;
  /// Takes a worker's result, which waits for commit(); the rest of its job is open again. Returns
  /// whether a signal stopped the worker.
  virtual bool take_back(int worker, const Bytes& result) = 0;
  /// Computes about a tenth of a second of rank 0's own job; false if it has none. Meanwhile rank 0
  /// MayBeLeft, and commit_all() may be called instead.
  virtual bool compute_one_block() = 0;
  /// Takes the finished part of rank 0's own job.
  virtual void hand_in_own() = 0;

  /// Returns roughly the rows of the waiting results.
  virtual std::size_t rows_waiting() const = 0;
  /// Writes waiting results in one transaction; some may wait a little longer.
  virtual void commit() = 0;
  /// Writes all waiting results, at the end.
  virtual void commit_all() = 0;

  virtual bool anything_open() const = 0;
  /// Returns whether all below the goal's end is done.
  virtual bool complete() const = 0;
  /// Counts also rank 0's job under way, so that the numbers move although jobs take seconds.
  virtual ProgressCounts counts() const = 0;
};

}  // namespace misalign::search
