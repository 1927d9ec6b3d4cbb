// Plain draws, counted.
#pragma once

#include <algorithm>

#include "search/draws/draw_evaluator.hpp"

namespace misalign::bench {

struct PlainCounts {
  std::uint64_t accepted = 0, undecided = 0;
};

/// Of the first `draws` draws. `see` gets one unit after the other: together they are too many.
template <class See>
PlainCounts count_plain_draws(search::DrawEvaluator& evaluator, std::uint64_t draws,
                              const See& see) {
  constexpr std::uint64_t kAtOnce = 1 << 18;
  PlainCounts counts;
  for (std::uint64_t lo = 0; lo < draws; lo += kAtOnce) {
    const schema::UnitRecord unit = work_off(evaluator, {lo, std::min(lo + kAtOnce, draws)});
    counts.accepted += unit.accepted;
    counts.undecided += unit.undecided.size();
    see(unit);
  }
  return counts;
}

}  // namespace misalign::bench
