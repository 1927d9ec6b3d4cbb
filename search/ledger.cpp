#include "search/ledger.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::search {

Ledger::Ledger(const DrawRange& wanted, const std::vector<DrawRange>& done) : end_(wanted.hi) {
  std::uint64_t next = wanted.lo;
  for (const DrawRange& range : done) {
    if (range.lo >= wanted.hi) break;
    if (range.lo > next) open_[next] = range.lo;
    next = std::max(next, range.hi);
  }
  if (next < wanted.hi) open_[next] = wanted.hi;
}

std::optional<DrawRange> Ledger::take(std::uint64_t most) {
  assert(most >= 1);
  if (open_.empty()) return std::nullopt;
  const auto [lo, hi] = *open_.begin();
  const DrawRange taken{lo, hi - lo > most ? lo + most : hi};
  open_.erase(open_.begin());
  if (taken.hi < hi) open_[taken.hi] = hi;
  given_out_ += taken.size();
  return taken;
}

void Ledger::finish(const DrawRange& taken, std::uint64_t done_to) {
  assert(given_out_ >= taken.size() && done_to >= taken.lo && done_to <= taken.hi);
  given_out_ -= taken.size();
  const std::uint64_t hi = std::min(taken.hi, end_);
  if (done_to < hi) open_[done_to] = hi;
}

void Ledger::cut(std::uint64_t end) {
  if (end >= end_) return;
  end_ = end;
  open_.erase(open_.lower_bound(end), open_.end());
  if (!open_.empty()) {
    auto& [lo, hi] = *open_.rbegin();
    hi = std::min(hi, end);
  }
}

std::uint64_t Ledger::open_draws() const {
  std::uint64_t draws = 0;
  for (const auto& [lo, hi] : open_) draws += hi - lo;
  return draws;
}

std::uint64_t unit_draws(double draws_per_s, double unit_s, std::uint64_t open_draws, int workers) {
  constexpr std::uint64_t kFirstUnit = 32, kLeastUnit = 8;
  const std::uint64_t by_time =
      draws_per_s > 0 ? static_cast<std::uint64_t>(std::min(draws_per_s * unit_s, 1e15))
                      : kFirstUnit;
  const std::uint64_t by_share =
      workers > 1 ? open_draws / (2 * static_cast<std::uint64_t>(workers)) : open_draws;
  return std::max(kLeastUnit, std::min(by_time, by_share));
}

}  // namespace misalign::search
