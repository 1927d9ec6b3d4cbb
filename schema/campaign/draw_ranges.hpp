// Computes with sets of draws as lists of ranges: disjoint, ascending, each from `lo` to before
// `hi`.
#pragma once

#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

/// Returns the union of the ranges below `end`; ranges that touch are joined. `ascending` by their
/// beginnings; they may overlap.
std::vector<DrawRange> united(const std::vector<DrawRange>& ascending,
                              std::uint64_t end = kEndOfDraws);

/// Returns the draws of `wanted` that are in none of `others`, which are ascending and do not
/// overlap.
std::vector<DrawRange> without(const std::vector<DrawRange>& wanted,
                               const std::vector<DrawRange>& others);

}  // namespace misalign::schema
