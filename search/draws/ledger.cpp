#include "search/draws/ledger.hpp"

#include <algorithm>
#include <cassert>

#include "schema/campaign/draw_ranges.hpp"

namespace misalign::search {

Ledger::Ledger(const DrawRange& wanted, const std::vector<DrawRange>& done) : end_(wanted.hi) {
  assert(wanted.lo <= wanted.hi);
  for (const DrawRange& range : schema::without({wanted}, done)) open(range);
}

void Ledger::open(const DrawRange& range) {
  if (range.lo >= range.hi) return;
  assert(range.hi <= end_ && !open_.contains(range.lo));
  open_[range.lo] = range.hi;
  open_draws_ += range.size();
}

std::optional<DrawRange> Ledger::take(std::uint64_t most) {
  assert(most >= 1);
  if (open_.empty()) return std::nullopt;
  const auto [lo, hi] = *open_.begin();
  const DrawRange taken{lo, hi - lo > most ? lo + most : hi};
  open_.erase(open_.begin());
  if (taken.hi < hi) open_[taken.hi] = hi;
  open_draws_ -= taken.size();
  draws_given_out_ += taken.size();
  given_out_.insert(taken.lo);
  return taken;
}

bool Ledger::take(const DrawRange& range) {
  auto at = open_.upper_bound(range.lo);
  if (at == open_.begin() || range.lo >= range.hi) return false;
  --at;
  const DrawRange whole{at->first, at->second};
  if (range.hi > whole.hi) return false;
  open_.erase(at);
  open_draws_ -= whole.size();
  open({whole.lo, range.lo});
  open({range.hi, whole.hi});
  draws_given_out_ += range.size();
  given_out_.insert(range.lo);
  return true;
}

void Ledger::finish(const DrawRange& taken, std::uint64_t done_to) {
  assert(given_out_.contains(taken.lo) && done_to >= taken.lo && done_to <= taken.hi);
  assert(draws_given_out_ >= taken.size());
  draws_given_out_ -= taken.size();
  given_out_.erase(taken.lo);
  open({done_to, std::min(taken.hi, end_)});
}

void Ledger::cut(std::uint64_t end) {
  if (end >= end_) return;
  end_ = end;
  while (!open_.empty() && open_.rbegin()->second > end) {
    const auto last = std::prev(open_.end());
    const DrawRange range{last->first, last->second};
    open_draws_ -= range.size();
    open_.erase(last);
    open({range.lo, std::min(range.hi, end)});
  }
}

}  // namespace misalign::search
