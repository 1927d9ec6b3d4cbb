// Which draws are done, given out and still open: a pure state machine, without clock, file or
// rank.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "schema/digest.hpp"

namespace misalign::search {

using schema::DrawRange;

class Ledger {
 public:
  /// `done` are disjoint and ascending; what they leave of `wanted` is open.
  Ledger(const DrawRange& wanted, const std::vector<DrawRange>& done);

  /// The lowest open draws, at most `most` (>= 1) of them, now given out; none if nothing is open.
  std::optional<DrawRange> take(std::uint64_t most);
  /// A range that was given out has come back done up to `done_to`; the rest is open again.
  void finish(const DrawRange& taken, std::uint64_t done_to);
  /// The goal ends here now: open draws from `end` on are wanted no more.
  void cut(std::uint64_t end);

  std::uint64_t open_draws() const;
  std::uint64_t draws_given_out() const { return given_out_; }
  bool complete() const { return open_.empty() && given_out_ == 0; }

 private:
  std::map<std::uint64_t, std::uint64_t> open_;  // lo -> hi, disjoint
  std::uint64_t given_out_ = 0;
  std::uint64_t end_;
};

/// How many draws a unit of about `unit_s` seconds has on a worker that makes `draws_per_s` (0: not
/// known yet), small enough that all `workers` end together.
std::uint64_t unit_draws(double draws_per_s, double unit_s, std::uint64_t open_draws, int workers);

}  // namespace misalign::search
