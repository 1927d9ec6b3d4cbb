// Disjoint sets of 0 ... n - 1, joined as ties between members are made (union-find).
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace misalign::solver {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : set_of_(count) {
    std::iota(set_of_.begin(), set_of_.end(), 0);
  }
  /// False if they were together before.
  bool tie(int member, int other) {
    const int from = set_of_[other], to = set_of_[member];
    if (from == to) return false;
    std::replace(set_of_.begin(), set_of_.end(), from, to);
    return true;
  }

 private:
  std::vector<int> set_of_;
};

}  // namespace misalign::solver
