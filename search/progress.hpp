// One plain line to stderr now and then.
#pragma once

#include <cstdint>

#include "search/stopwatch.hpp"

namespace misalign::search {

enum class ProgressStyle { plain, none };

struct ProgressCounts {
  std::uint64_t draws, accepted;  ///< of this run
  std::uint64_t draws_left;
  bool limited;  ///< whether draws_left means anything
};

class Progress {
 public:
  explicit Progress(ProgressStyle style);
  /// Prints if 30 s have gone by (10 s the first time), or if `now`.
  void show(const ProgressCounts& counts, bool now = false);
  double seconds() const { return watch_.seconds(); }

 private:
  ProgressStyle style_;
  Stopwatch watch_;
  double next_s_ = 10;
};

}  // namespace misalign::search
