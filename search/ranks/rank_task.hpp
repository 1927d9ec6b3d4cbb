// The task that the ranks of a campaign share, as its coordinator sees it: jobs that go out,
// results that come back and are written.
#pragma once

#include <optional>

#include "search/ranks/messages.hpp"
#include "search/terminal/progress_text.hpp"

namespace misalign::search {

class RankTask {
 public:
  virtual ~RankTask() = default;

  /// A job for a worker that has none; nothing if none is open.
  virtual std::optional<Bytes> assign(int worker) = 0;
  virtual bool has_job(int worker) const = 0;
  /// What a worker has done of its job; the rest is open again. Waits for commit(). Whether the
  /// worker was stopped by a signal.
  virtual bool take_back(int worker, const Bytes& result) = 0;
  /// Rank 0 does a part of a job of its own, about a tenth of a second; false if it has none. While
  /// that is computed it MayBeLeft, and commit_all() may be called instead.
  virtual bool compute_one_block() = 0;
  /// Takes back what it has done of it.
  virtual void hand_in_own() = 0;

  /// Of the results that wait, roughly.
  virtual std::size_t rows_waiting() const = 0;
  /// Writes them, in one transaction; some may wait a little longer.
  virtual void commit() = 0;
  /// The last time: all of them.
  virtual void commit_all() = 0;

  virtual bool anything_open() const = 0;
  /// Nothing is left below the goal's end.
  virtual bool complete() const = 0;
  /// With what rank 0 has under way, so that the numbers move although jobs take seconds.
  virtual ProgressCounts counts() const = 0;
};

}  // namespace misalign::search
