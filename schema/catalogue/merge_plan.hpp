// Chooses units of several ledgers for one ledger, by arithmetic on ranges.
#pragma once

#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

struct MergePlan {
  /// Units of each ledger: those copied, which do not overlap in all ledgers together, and those
  /// that overlap them, which are compared.
  std::vector<std::vector<DrawRange>> kept, compared;
  /// Draws of units that were not kept: to be computed again.
  std::vector<DrawRange> recomputed;
};

/// Keeps the units that leave the fewest draws to compute again (weighted interval scheduling).
/// Each ledger's units are disjoint and ascending; of equal ones that of the first ledger is kept.
MergePlan plan_merge(const std::vector<std::vector<DrawRange>>& ledgers);

}  // namespace misalign::schema
