// Finds the folding of a perforated sheet from a folded state of it: the base of a mesh that was
// designed for that state and does not fold rigidly as a whole.
#pragma once

#include <variant>

#include "solver/pattern/isometric_pair.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// Largest distance (panel widths) of a vertex at the target between the path from flat and the one
/// from the target: a thousand times what rounding leaves of paths that are the same.
inline constexpr double kJoined_widths = 1e-7;

struct FollowedBase {
  BaseFolding folding;
  double target_deg;  ///< pilot angle of the folded state
  double joined_mm;   ///< largest distance of the two paths at the target
};

/// Reason for which a folded state has no path that can be followed from flat.
struct NoFollowedBase {
  enum class Cause {
    open,      ///< loops do not close at the folded state
    turns,     ///< the pilot turns back on the way to flat, at `pilot_deg`
    not_flat,  ///< crease `edge` is folded by `angle_deg` where the pilot is nearly flat
    apart,     ///< the path that leaves flat is not that of the folded state: apart by `apart_mm`
    lost       ///< the path from flat is lost before the folded state
  } cause;
  double pilot_deg = 0;
  int edge = -1;
  double angle_deg = 0, apart_mm = 0;
};

/// Follows the path of the perforated sheet from `folded_mm`, where its panels are congruent to the
/// flat ones, to flat and to its other end, then from flat again. The holes leave one degree of
/// freedom by the number of equations; the pilot is a crease.
std::variant<FollowedBase, NoFollowedBase> follow_from_target(const CreasePattern& sheet,
                                                              const std::vector<int>& holes,
                                                              int pilot_edge,
                                                              const FoldedVertices& folded_mm);

}  // namespace misalign::solver
