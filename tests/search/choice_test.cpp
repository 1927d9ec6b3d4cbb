// A spread of candidates against every other choice, and against near twins.
#include "search/checks/choice.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "solver/design/farthest_first.hpp"

namespace misalign::search {
namespace {

double nearest(const Eigen::MatrixXd& points, const std::vector<int>& taken) {
  double least = std::numeric_limits<double>::infinity();
  for (const int a : taken) {
    for (const int b : taken) {
      if (a < b) least = std::min(least, (points.col(a) - points.col(b)).norm());
    }
  }
  return least;
}

// Gonzalez' bound, against the best of every set of four.
TEST(FarthestFirst, IsAtLeastHalfAsFarApartAsPossible) {
  std::mt19937 words(1985);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd points =
        Eigen::MatrixXd::NullaryExpr(2, 12, [&] { return coordinate(words); });
    const std::vector<int> taken = solver::farthest_first(points, 4);
    ASSERT_EQ(taken.size(), 4u);
    EXPECT_EQ(taken[0], 0) << "the best one is among them";
    double best = 0;
    for (int set = 0; set < 1 << 12; ++set) {
      if (__builtin_popcount(static_cast<unsigned>(set)) != 4) continue;
      std::vector<int> others;
      for (int k = 0; k < 12; ++k) {
        if (set >> k & 1) others.push_back(k);
      }
      best = std::max(best, nearest(points, others));
    }
    EXPECT_GE(nearest(points, taken), best / 2 - 1e-12);
  }
}

TEST(FarthestFirst, TakesEachOnceEvenAmongEquals) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_EQ(solver::farthest_first(points, 9), (std::vector<int>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace misalign::search
