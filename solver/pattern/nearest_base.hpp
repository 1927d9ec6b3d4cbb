// A sheet that folds rigidly, near one that does not: the base of a mesh whose coordinates are
// rounded, and of one that folds only once it is perforated.
#pragma once

#include <optional>

#include "solver/pattern/base_folding.hpp"

namespace misalign::solver {

/// Panel widths: 0.4 mm on panels of 80 mm, the paper's shifts. A mesh as near as this to a sheet
/// that folds rigidly stands for it.
inline constexpr double kStandsFor_widths = 0.005;

struct NearestBase {
  CreasePattern sheet;
  BaseFolding folding;
  double off_mm;  ///< how far the farthest vertex was moved
};

/// The nearest sheet, by all vertices, that folds by the ways that vertices have in `unclosed`, as
/// far as Newton's method finds it. One that folds flat, whose path ends nowhere short of that; but
/// if only one that does not is near enough to stand for the mesh, that one. None if neither is
/// found. Coordinates are multiples of 1e-9 mm, since the digits after those are rounding's.
std::optional<NearestBase> nearest_base(const CreasePattern& sheet, const BaseFolding& unclosed);

}  // namespace misalign::solver
