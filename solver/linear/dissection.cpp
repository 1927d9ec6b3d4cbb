#include "solver/linear/dissection.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {
namespace {

// Sheets of at most kWholeSheet loops are not dissected, since Markowitz' order alone is as good;
// parts of a larger sheet are divided down to kUndivided loops.
constexpr int kWholeSheet = 24, kUndivided = 8;

// A cut leaves at least this share of the loops on either side.
constexpr double kLeastShare = 0.25;

// Unknowns on a cut through a part, divided by the square root of its number of loops.
constexpr double kCutOfSquareRoot = 3;

// Multiplications in eliminating `inside` unknowns whose loops also have `outside` other ones. A
// loop has half as many equations as unknowns and shares each unknown with one other loop: there
// are inside + outside / 2 equations.
double elimination_cost(double inside, double outside) {
  const double a = 0.5 * outside, b = outside;
  return inside * (inside * inside / 3 + (a + b) * inside / 2 + a * b);
}

// Expected cost of `loops` loops that are halved again and again, with `outside` unknowns separated
// already.
double expected_cost(double loops, double outside) {
  if (loops <= kUndivided) {
    constexpr double kOfDense = 0.1;  // Markowitz' order within a part
    return kOfDense * elimination_cost(std::max(0.0, 6 * loops - 0.5 * outside), outside);
  }
  const double cut = kCutOfSquareRoot * std::sqrt(loops);
  return elimination_cost(cut, outside) + 2 * expected_cost(loops / 2, outside / 2 + cut);
}

class Dissection {
 public:
  Dissection(const Mechanism& mechanism, const FlatVertices& vertices_mm)
      : loops_of_(mechanism.unknowns), rank_(mechanism.loops.size(), kElsewhere) {
    std::vector<int> loop_of_row(mechanism.equations);
    for (std::size_t loop = 0; loop < mechanism.loops.size(); ++loop) {
      std::fill_n(loop_of_row.begin() + mechanism.loops[loop].first_row, mechanism.loops[loop].rows,
                  static_cast<int>(loop));
    }
    for (const JacobianEntry& entry : jacobian_entries(mechanism)) {
      assert(entry.column < mechanism.unknowns && entry.row < mechanism.equations);
      std::vector<int>& loops = loops_of_[entry.column];
      const int loop = loop_of_row[entry.row];
      if (std::find(loops.begin(), loops.end(), loop) == loops.end()) loops.push_back(loop);
    }
    find_places(mechanism, vertices_mm);
    std::vector<int> loops(mechanism.loops.size()), unknowns(loops_of_.size());
    std::iota(loops.begin(), loops.end(), 0);
    std::iota(unknowns.begin(), unknowns.end(), 0);
    if (static_cast<int>(loops.size()) <= kWholeSheet) {
      parts_.push_back(unknowns);
    } else {
      divide(std::move(loops), unknowns, {});
    }
  }

  const std::vector<std::vector<int>>& parts() const { return parts_; }

 private:
  static constexpr int kElsewhere = -1, kDirections = 4;

  // A loop's coordinates along x, y and both diagonals, in whole parts of the distance between
  // neighbours: rounding must not choose between loops in a line.
  using Place = std::array<std::int64_t, kDirections>;

  struct Cut {
    int direction = 0, left = 0;  // left: number of loops on that side
    double cost = HUGE_VAL;
  };

  // Number of unknowns whose first or last loop has each rank.
  struct Ends {
    std::vector<int> first, last;
    int all = 0;
  };

  void find_places(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
    constexpr double kParts = 1e6;
    std::vector<Eigen::Array2d> middles;
    for (const Loop& loop : mechanism.loops) {
      Eigen::Array2d middle = Eigen::Array2d::Zero();
      for (const Passage& passage : loop.passages)
        middle += vertices_mm.col(passage.vertex).array();
      middles.push_back(middle / static_cast<double>(loop.passages.size()));
    }
    Eigen::Array2d distances = Eigen::Array2d::Zero();
    double neighbours = 0;
    for (const std::vector<int>& loops : loops_of_) {
      for (std::size_t k = 1; k < loops.size(); ++k, ++neighbours) {
        distances += (middles[loops[k]] - middles[loops[0]]).abs();
      }
    }
    for (const Eigen::Array2d& middle : middles) {
      const Eigen::Array2d at = kParts * neighbours * middle / distances;
      const auto whole = [](double x) { return static_cast<std::int64_t>(std::llround(x)); };
      places_.push_back(
          {whole(at.x()), whole(at.y()), whole(at.x() + at.y()), whole(at.x() - at.y())});
    }
  }

  void sort_along(int direction, std::vector<int>& loops) const {
    std::sort(loops.begin(), loops.end(), [&](int a, int b) {
      const Place &p = places_[a], &q = places_[b];
      return std::tuple(p[direction], p[direction ^ 1], a) <
             std::tuple(q[direction], q[direction ^ 1], b);
    });
  }

  Ends ends_of(const std::vector<int>& unknowns, int loops) const {
    Ends ends{std::vector<int>(loops), std::vector<int>(loops)};
    for (const int unknown : unknowns) {
      int first = loops, last = kElsewhere;
      for (const int loop : loops_of_[unknown]) {
        if (rank_[loop] == kElsewhere) continue;
        first = std::min(first, rank_[loop]);
        last = std::max(last, rank_[loop]);
      }
      if (last == kElsewhere) continue;
      ++ends.first[first];
      ++ends.last[last];
      ++ends.all;
    }
    return ends;
  }

  // Replaces `best` by the best cut across `direction` if that is cheaper.
  void try_direction(int direction, std::vector<int> loops, const std::vector<int>& unknowns,
                     const std::vector<int>& outside, Cut& best) {
    constexpr double kCheaper = 1 - 1e-9;  // rounding must not choose
    const int count = static_cast<int>(loops.size());
    sort_along(direction, loops);
    for (int k = 0; k < count; ++k) rank_[loops[k]] = k;
    const Ends inner = ends_of(unknowns, count), outer = ends_of(outside, count);
    for (const int loop : loops) rank_[loop] = kElsewhere;
    int begun = 0, ended = 0, outer_begun = 0, outer_ended = 0;
    for (int left = 1; left < count; ++left) {
      begun += inner.first[left - 1];
      ended += inner.last[left - 1];
      outer_begun += outer.first[left - 1];
      outer_ended += outer.last[left - 1];
      if (std::min(left, count - left) < kLeastShare * count) continue;
      const double between = begun - ended;
      const double cost = elimination_cost(between, outer.all) +
                          expected_cost(left, outer_begun + between) +
                          expected_cost(count - left, outer.all - outer_ended + between);
      if (cost < kCheaper * best.cost) best = {direction, left, cost};
    }
  }

  // `outside`: unknowns of these loops that are separated already.
  void divide(std::vector<int> loops, const std::vector<int>& unknowns,
              const std::vector<int>& outside) {
    if (static_cast<int>(loops.size()) <= kUndivided) {
      parts_.push_back(unknowns);
      return;
    }
    Cut cut;
    for (int direction = 0; direction < kDirections; ++direction) {
      try_direction(direction, loops, unknowns, outside, cut);
    }
    assert(cut.left > 0 && cut.left < std::ssize(loops));  // both parts are smaller
    sort_along(cut.direction, loops);
    const auto middle = loops.begin() + cut.left;
    for (auto loop = loops.begin(); loop != loops.end(); ++loop) rank_[*loop] = loop >= middle;
    std::vector<int> in_left, in_right, in_both, outside_left, outside_right;
    const auto sort_out = [&](int unknown, std::vector<int>* both, std::vector<int>& left,
                              std::vector<int>& right) {
      bool is_left = false, is_right = false;
      for (const int loop : loops_of_[unknown]) {
        is_left = is_left || rank_[loop] == 0;
        is_right = is_right || rank_[loop] == 1;
      }
      if (both && is_left && is_right) {
        both->push_back(unknown);
        is_left = is_right = false;
      }
      if (is_left) left.push_back(unknown);
      if (is_right) right.push_back(unknown);
    };
    for (const int unknown : unknowns) sort_out(unknown, &in_both, in_left, in_right);
    for (const int unknown : outside) sort_out(unknown, nullptr, outside_left, outside_right);
    for (const int loop : loops) rank_[loop] = kElsewhere;
    outside_left.insert(outside_left.end(), in_both.begin(), in_both.end());
    outside_right.insert(outside_right.end(), in_both.begin(), in_both.end());
    divide({loops.begin(), middle}, in_left, outside_left);
    divide({middle, loops.end()}, in_right, outside_right);
    parts_.push_back(in_both);
  }

  std::vector<std::vector<int>> loops_of_;  // per unknown
  std::vector<Place> places_;               // per loop
  std::vector<int> rank_;                   // per loop, while its part is divided
  std::vector<std::vector<int>> parts_;
};

}  // namespace

std::vector<std::vector<int>> dissect(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  return Dissection(mechanism, vertices_mm).parts();
}

}  // namespace misalign::solver
