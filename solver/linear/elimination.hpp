// The order in which the Jacobian of one topology is eliminated, found once: the pattern of its
// nonzeros is the same for every draw, so no search and no memory are needed afterwards.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

/// Half-open range of places in one of the lists below.
struct Stretch {
  std::int32_t begin, end;
  int size() const { return end - begin; }
};

/// The k-th step: divide the pivot's column below it, subtract multiples of its row.
struct Pivot {
  std::int32_t slot;          ///< of the pivot itself
  Stretch upper;              ///< slots of its row beyond the pivot: neighbours, in column order
  Stretch lower;              ///< places in lower_slot: its column in the rows below
  Stretch above;              ///< places in above_slot: its column in the rows above
  std::int32_t first_target;  ///< in `targets`: upper.size() of them for each row below
};

/// An elimination of the n x (n + 1) Jacobian, pilot's column last: after n - 1 pivots one equation
/// is left, in the pilot and its partner. Whichever of the two is held, the same factors serve;
/// with neither held they give the tangent, also where the pilot turns. Every nonzero of the
/// factors has a slot; row by row, in column order.
struct Elimination {
  int equations;
  std::vector<int> row_of;     ///< equation eliminated i-th
  std::vector<int> column_of;  ///< unknown in column i, n + 1 of them; partner and pilot last
  int permutation_sign;        ///< of the rows and the first n columns together
  int slots;
  std::vector<std::int32_t> slot_of_value;  ///< per value of `evaluate`
  std::vector<std::int32_t> fill_slots;     ///< that only the elimination fills
  std::vector<Pivot> pivots;
  std::vector<std::int32_t> column;  ///< per slot
  std::vector<std::int32_t> lower_slot, lower_row, above_slot, above_row, targets;

  int partner() const { return column_of[equations - 1]; }
  /// Multiplications, with one subtraction each, of one factorisation.
  std::size_t operations() const { return targets.size(); }
};

/// Markowitz' order (least fill first) within the parts of a nested dissection, among pivots that
/// are large in their column on the base folding at ten angles from 1 to 178 degrees and keep their
/// sign between them; how large is the least that solves well enough at ten other angles, on the
/// base folding and off it. The partner is a crease far from the pilot that moves fast near the
/// folded end. The same on every machine.
Elimination plan_elimination(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm);

}  // namespace misalign::solver
