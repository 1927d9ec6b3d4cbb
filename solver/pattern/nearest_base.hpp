// Finds a rigidly folding sheet near one that does not fold: the base of a mesh whose coordinates
// are rounded, or that folds only once it is perforated.
#pragma once

#include <optional>

#include "solver/pattern/base_folding.hpp"

namespace misalign::solver {

/// A mesh within this many panel widths of a rigidly folding sheet is taken for that sheet: 0.4 mm
/// on panels of 80 mm, the paper's shifts.
inline constexpr double kStandsFor_widths = 0.005;

struct NearestBase {
  CreasePattern sheet;
  BaseFolding folding;
  double off_mm;  ///< largest distance that a vertex was moved
};

/// Returns the nearest sheet, over all vertices, that folds in the ways that vertices have in
/// `unclosed`; none if Newton's method finds none. The sheet is flat-foldable with a path up to 180
/// degrees, unless only a sheet that is not is near enough to be taken for the mesh. Coordinates
/// are multiples of 1e-9 mm, since the digits after those are rounding's.
std::optional<NearestBase> nearest_base(const CreasePattern& sheet, const BaseFolding& unclosed);

}  // namespace misalign::solver
