// Finds the fewest diagonals that still drive the folding everywhere.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

namespace misalign::solver {

struct FewDiagonals {
  std::vector<int> diagonals;  ///< ascending
  double share;                ///< their least total over that of all diagonals
  bool proven;                 ///< true if no smaller set suffices
  /// Best set found with one diagonal fewer, and its share; empty where there is none.
  std::vector<int> fewer = {};
  double share_of_fewer = 0;
};

/// The smallest set of columns whose sum is everywhere at least `share` of the least sum of all
/// columns; of several as small the one with the greatest least sum. `moments` has a row for each
/// place along the way (at least one) and a column for each diagonal; the least sum of all columns
/// must be positive. Up to 16 columns every set is compared; of more, columns are removed one by
/// one, each time the one whose loss costs least, and the set is proven only if no smaller one
/// reaches the share in the worst row alone. No set has both diagonals of a pair of `never_both`,
/// such as springs that touch; none: no such set was found that reaches the share.
std::optional<FewDiagonals> few_diagonals(const Eigen::MatrixXd& moments, double share,
                                          const std::vector<std::pair<int, int>>& never_both = {});

}  // namespace misalign::solver
