// Compares two patterns: by what is folded, not by their words, of which a key that is not written
// would be missing in both.
#pragma once

#include <tuple>

#include "schema/pattern/pattern_file.hpp"

namespace misalign::stress {

inline bool same_pattern(const schema::Pattern& a, const schema::Pattern& b) {
  const auto parts = [](const schema::Pattern& pattern) {
    const solver::PerforatedSheet& base = pattern.base;
    return std::tie(base.sheet.facets, base.sheet.places, base.sheet.panel_width_mm, base.holes,
                    base.folding.assignment());
  };
  const auto numbers = [](const schema::Pattern& pattern) {
    const solver::BaseFolding& folding = pattern.base.folding;
    return std::tuple(folding.pilot_edge(), folding.side(), folding.end_deg());
  };
  return parts(a) == parts(b) && numbers(a) == numbers(b) &&
         a.base.sheet.vertices_mm == b.base.sheet.vertices_mm && a.shifts_mm == b.shifts_mm;
}

}  // namespace misalign::stress
