// Plans a fixed-order elimination symbolically: its factors, products and their places. The pattern
// of nonzeros is the same for every draw, so it is found once.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

/// An elimination of the n x (n + 1) Jacobian, pilot's column last: after n - 1 pivots one equation
/// is left, in the pilot and its partner. Whichever of the two is held, the same factors serve;
/// with neither held they give the tangent, also where the pilot turns. Every nonzero of the
/// factors has a slot; row by row, in column order.
struct Elimination {
  /// Half-open range of places in one of the lists below.
  struct Range {
    std::int32_t begin, end;
    int size() const { return end - begin; }
  };

  /// The k-th step: divide the pivot's column below it, subtract multiples of its row.
  struct Pivot {
    std::int32_t slot;  ///< the pivot's slot
    Range upper;        ///< slots of its row beyond the pivot: neighbours, in column order
    Range lower;        ///< places in lower_slot: its column in the rows below
    Range above;        ///< places in above_slot: its column in the rows above
  };

  /// Neighbouring pivots whose rows have the same columns beyond them, and whose columns have the
  /// same rows below them (a supernode; Demmel et al., SuperLU, 1999): dense, so that a register
  /// loaded once serves many multiplications. Every slot is still updated in the order of the
  /// pivots: the bits are those of one pivot after another.
  struct Block {
    std::int32_t first, end;    ///< pivots
    Range upper, lower;         ///< ranges of the last pivot
    Range fill;                 ///< places in fill_slots that no earlier block has touched
    std::int32_t first_target;  ///< place in `targets`: upper.size() slots for each row below
    int size() const { return end - first; }
  };

  int equations;
  std::vector<int> row_of;     ///< equation eliminated i-th
  std::vector<int> column_of;  ///< unknown in column i, n + 1 of them; partner and pilot last
  int permutation_sign;        ///< sign of rows' and first n columns' permutations
  int slots;
  std::vector<std::int32_t> slot_of_value;  ///< per value of `evaluate`
  std::vector<std::int32_t> fill_slots;     ///< slots that only the elimination fills
  std::vector<Pivot> pivots;
  std::vector<Block> blocks;
  int most_packed;  ///< largest number of multiplications of a block's pivots with a row below
  std::vector<std::int32_t> column;  ///< per slot
  std::vector<std::int32_t> lower_slot, lower_row, above_slot, above_row, targets;

  int partner() const { return column_of[equations - 1]; }
  /// Multiplications, with one subtraction each, of one factorisation.
  std::size_t operations() const;
};

/// Plans the elimination of a matrix with nonzeros at `entries`, its rows and columns in the given
/// order: n rows, n + 1 columns, partner and pilot last.
Elimination eliminate_in_order(const std::vector<JacobianEntry>& entries,
                               const std::vector<int>& row_of, const std::vector<int>& column_of);

}  // namespace misalign::solver
