// A spread of points: few of many, far from each other.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace misalign::search {

/// Columns of `points`, `count` of them or all: the first column, then again and again the one that
/// is farthest from all taken so far (Gonzalez 1985: the least distance between two of them is at
/// least half of the greatest possible). Of several as far the first.
std::vector<int> farthest_first(const Eigen::MatrixXd& points, std::size_t count);

}  // namespace misalign::search
