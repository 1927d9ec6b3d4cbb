#include "schema/campaign/draw_ranges.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::schema {

std::vector<DrawRange> united(const std::vector<DrawRange>& ascending, std::uint64_t end) {
  assert(std::ranges::is_sorted(ascending, {}, &DrawRange::lo));
  std::vector<DrawRange> all;
  for (const DrawRange& range : ascending) {
    if (range.lo >= end) break;
    const std::uint64_t hi = std::min(range.hi, end);
    if (!all.empty() && range.lo <= all.back().hi) {
      all.back().hi = std::max(all.back().hi, hi);
    } else {
      all.push_back({range.lo, hi});
    }
  }
  return all;
}

std::vector<DrawRange> without(const std::vector<DrawRange>& wanted,
                               const std::vector<DrawRange>& others) {
  assert(std::ranges::is_sorted(wanted, {}, &DrawRange::lo));
  assert(std::ranges::is_sorted(others, {}, &DrawRange::lo));
  std::vector<DrawRange> rest;
  auto other = others.begin();
  for (const DrawRange& range : wanted) {
    std::uint64_t next = range.lo;
    while (other != others.end() && other->hi <= next) ++other;
    for (auto at = other; at != others.end() && at->lo < range.hi; ++at) {
      if (at->lo > next) rest.push_back({next, at->lo});
      next = std::max(next, at->hi);
    }
    if (next < range.hi) rest.push_back({next, range.hi});
  }
  return rest;
}

}  // namespace misalign::schema
