// Disjoint sets of 0 ... n - 1, joined as ties between members are made (union-find).
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace misalign::solver {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }
  /// False if they were together before.
  bool tie(int one, int other) {
    const int from = of_[other], to = of_[one];
    if (from == to) return false;
    std::replace(of_.begin(), of_.end(), from, to);
    return true;
  }

 private:
  std::vector<int> of_;
};

}  // namespace misalign::solver
