// Compares a flat sheet with a folded state of it, panel by panel, and finds the nearest pair whose
// panels are congruent.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// 3 x N vertex coordinates of a folded sheet, mm.
using FoldedVertices = Eigen::Matrix3Xd;

/// A pair whose lengths differ by no more than this many panel widths is taken for a sheet and its
/// folded state: 0.1 mm on panels of 80 mm.
inline constexpr double kNearlyIsometric_widths = 0.00125;

/// The edge or diagonal of a kept panel whose lengths differ most.
struct LengthMisfit {
  int from = -1, to = -1;
  double flat_mm = 0, folded_mm = 0;

  double mm() const { return std::abs(folded_mm - flat_mm); }
};
LengthMisfit largest_length_misfit(const CreasePattern& sheet, const std::vector<int>& holes,
                                   const FoldedVertices& folded_mm);

/// The kept panel whose folded corners are farthest from a plane: the distance of its diagonals.
struct PlaneMisfit {
  int facet = -1;
  double mm = 0;
};
PlaneMisfit largest_plane_misfit(const CreasePattern& sheet, const std::vector<int>& holes,
                                 const FoldedVertices& folded_mm);

struct IsometricPair {
  FlatVertices flat_mm;
  FoldedVertices folded_mm;
  double moved_mm;  ///< largest distance that a vertex was moved, flat or folded
};

/// Moves flat and folded vertices together by the least sum of squares, to first order in the
/// misfit, such that every kept panel is plane and has its flat shape to 1e-12 panel widths
/// (Gauss-Newton method on the constraints). None if that does not converge.
std::optional<IsometricPair> nearest_isometric_pair(const CreasePattern& sheet,
                                                    const std::vector<int>& holes,
                                                    const FoldedVertices& folded_mm);

}  // namespace misalign::solver
