// The base of a campaign or a pattern file: what is folded, before any shift.
#pragma once

#include <vector>

#include "solver/pattern/base_folding.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// A correct sheet with holes.
struct PerforatedSheet {
  CreasePattern sheet;
  std::vector<int> holes;  ///< facet indices, ascending
  BaseFolding folding;
};

}  // namespace misalign::solver
