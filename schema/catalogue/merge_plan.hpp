// Chooses the units of several ledgers that make up one ledger: pure arithmetic of ranges.
#pragma once

#include <vector>

#include "schema/campaign/draw_range.hpp"

namespace misalign::schema {

struct MergePlan {
  /// Of each ledger: units taken as they are, no two overlapping in all of them together; and those
  /// that overlap them, to be compared.
  std::vector<std::vector<DrawRange>> kept, compared;
  /// What is in some unit but in none that is kept: draws to make again.
  std::vector<DrawRange> recomputed;
};

/// Keeps those units that leave the fewest draws to make again (weighted interval scheduling). Each
/// ledger's units are disjoint and ascending; equal ones are taken from the first ledger.
MergePlan plan_merge(const std::vector<std::vector<DrawRange>>& ledgers);

}  // namespace misalign::schema
