#include "solver/linear/dissection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>

#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {
namespace {

// Below this many loops Markowitz' order alone is as good.
constexpr std::size_t kUndivided = 24;

class Dissection {
 public:
  Dissection(const Mechanism& mechanism, const FlatVertices& vertices_mm)
      : loops_of_(mechanism.unknowns) {
    std::vector<int> loop_of_row(mechanism.equations);
    for (const Loop& loop : mechanism.loops) {
      std::fill_n(loop_of_row.begin() + loop.first_row, loop.rows,
                  static_cast<int>(middles_.size()));
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const Passage& passage : loop.passages) middle += vertices_mm.col(passage.vertex);
      middles_.push_back(middle / static_cast<double>(loop.passages.size()));
    }
    for (const JacobianEntry& entry : jacobian_entries(mechanism)) {
      loops_of_[entry.column].insert(loop_of_row[entry.row]);
    }
    std::vector<int> loops(middles_.size()), unknowns(loops_of_.size());
    std::iota(loops.begin(), loops.end(), 0);
    std::iota(unknowns.begin(), unknowns.end(), 0);
    divide(loops, unknowns);
  }

  const std::vector<std::vector<int>>& parts() const { return parts_; }

 private:
  void divide(std::vector<int> loops, const std::vector<int>& unknowns) {
    if (loops.size() <= kUndivided) {
      parts_.push_back(unknowns);
      return;
    }
    Eigen::AlignedBox2d box;
    for (const int loop : loops) box.extend(middles_[loop]);
    const int along = box.sizes().x() >= box.sizes().y() ? 0 : 1;
    const auto half = loops.begin() + static_cast<std::ptrdiff_t>(loops.size() / 2);
    std::sort(loops.begin(), loops.end(), [&](int a, int b) {
      return std::pair(middles_[a][along], a) < std::pair(middles_[b][along], b);
    });
    const std::set<int> left(loops.begin(), half);
    std::vector<int> in_left, in_right, in_both;
    for (const int unknown : unknowns) {
      const auto& mine = loops_of_[unknown];
      const auto inside =
          std::count_if(mine.begin(), mine.end(), [&](int loop) { return left.contains(loop); });
      const bool all_left = inside == static_cast<std::ptrdiff_t>(mine.size());
      (all_left ? in_left : inside == 0 ? in_right : in_both).push_back(unknown);
    }
    divide({loops.begin(), half}, in_left);
    divide({half, loops.end()}, in_right);
    parts_.push_back(in_both);
  }

  std::vector<std::set<int>> loops_of_;  // per unknown
  std::vector<Eigen::Vector2d> middles_;
  std::vector<std::vector<int>> parts_;
};

}  // namespace

std::vector<std::vector<int>> dissect(const Mechanism& mechanism, const FlatVertices& vertices_mm) {
  return Dissection(mechanism, vertices_mm).parts();
}

}  // namespace misalign::solver
