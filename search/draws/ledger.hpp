// Keeps the ledger of draws: done, given out and open. A pure state machine, without clock, file or
// rank.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::search {

using schema::DrawRange;

class Ledger {
 public:
  /// `done` are disjoint and ascending; the rest of `wanted` is open.
  Ledger(const DrawRange& wanted, const std::vector<DrawRange>& done);

  /// Gives out the lowest open draws, at most `most` (>= 1); none if nothing is open.
  std::optional<DrawRange> take(std::uint64_t most);
  /// Gives out these draws; false if they are not all open.
  bool take(const DrawRange& range);
  /// Takes back a range that is done up to `done_to`; the rest is open again.
  void finish(const DrawRange& taken, std::uint64_t done_to);
  /// Ends the goal at `end`: draws from there on, open or given out, are not needed any more.
  void cut(std::uint64_t end);

  std::uint64_t open_draws() const { return open_draws_; }
  std::uint64_t draws_given_out() const { return draws_given_out_; }
  /// Returns whether nothing below the end is open or given out.
  bool complete() const {
    return open_.empty() && (given_out_.empty() || *given_out_.begin() >= end_);
  }

 private:
  void open(const DrawRange& range);

  std::map<std::uint64_t, std::uint64_t> open_;  // lo -> hi, disjoint
  std::set<std::uint64_t> given_out_;            // lo of each
  std::uint64_t open_draws_ = 0, draws_given_out_ = 0;
  std::uint64_t end_;
};

}  // namespace misalign::search
