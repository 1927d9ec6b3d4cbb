// Cheapest covers against all sets of options, which are tried one by one.
#include "solver/fitting/cheapest_cover.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

namespace misalign::solver {
namespace {

constexpr unsigned kCoverSeed = 20261130;

class RandomCovers {
 public:
  // Groups of options with a few rows; gains of any sign, prices in hundredths.
  CoverProblem next(int groups, int each, Eigen::Index rows) {
    CoverProblem problem;
    for (int g = 0; g < groups; ++g) {
      std::vector<int> group;
      for (int k = 0; k < each; ++k) {
        CoverOption option{whole(0, 300) / 100.0, Eigen::VectorXd(rows)};
        for (double& gain : option.gains) gain = whole(-2, 9);
        group.push_back(static_cast<int>(problem.options.size()));
        problem.options.push_back(std::move(option));
      }
      problem.cliques.push_back(std::move(group));
    }
    std::vector<int> pair = problem.cliques[0];
    pair.insert(pair.end(), problem.cliques[1].begin(), problem.cliques[1].end());
    problem.cliques.push_back(std::move(pair));
    problem.demand = Eigen::VectorXd(rows);
    for (double& demand : problem.demand) demand = whole(4, 20);
    return problem;
  }

 private:
  int whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  std::mt19937 random_{kCoverSeed};
};

std::optional<double> cheapest_of_all(const CoverProblem& problem) {
  std::optional<double> best;
  for (unsigned set = 0; set < 1U << problem.options.size(); ++set) {
    const auto has = [&](int option) { return (set >> option & 1U) != 0; };
    const auto is_allowed = [&](const std::vector<int>& clique) {
      return std::ranges::count_if(clique, has) <= 1;
    };
    if (!std::ranges::all_of(problem.cliques, is_allowed)) continue;
    double price = 0;
    Eigen::VectorXd left = problem.demand;
    for (int option = 0; option < std::ssize(problem.options); ++option) {
      if (!has(option)) continue;
      price += problem.options[static_cast<std::size_t>(option)].price;
      left -= problem.options[static_cast<std::size_t>(option)].gains;
    }
    if (left.maxCoeff() <= 0 && (!best || price < *best)) best = price;
  }
  return best;
}

TEST(CheapestCover, IsTheCheapestOfAllSets) {
  RandomCovers random;
  int covered = 0, none = 0;
  for (int k = 0; k < 200; ++k) {
    const CoverProblem problem = random.next(5, 3, 4);
    const std::optional<double> best = cheapest_of_all(problem);
    const Cover cover = cheapest_cover(problem);
    ASSERT_EQ(cover.end, best ? Cover::StopReason::optimal : Cover::StopReason::none) << k;
    ++(best ? covered : none);
    if (!best) continue;
    // Prices are hundredths, which sums keep to rounding.
    EXPECT_NEAR(cover.price, *best, 1e-6) << "seed " << kCoverSeed << ", problem " << k;
    EXPECT_NEAR(cover.bound, *best, 1e-6);
  }
  EXPECT_GT(covered, 40);
  EXPECT_GT(none, 10);
}

TEST(CheapestCover, CountsOnlyBelowAPrice) {
  RandomCovers random;
  int cheaper = 0, dearer = 0;
  for (int k = 0; k < 50; ++k) {
    const CoverProblem problem = random.next(4, 3, 3);
    const std::optional<double> best = cheapest_of_all(problem);
    if (!best) continue;
    const Cover below = cheapest_cover(problem, {.price_below = *best + 0.005});
    EXPECT_NEAR(below.price, *best, 1e-6);
    ++cheaper;
    const Cover not_below = cheapest_cover(problem, {.price_below = *best - 0.005});
    EXPECT_EQ(not_below.end, Cover::StopReason::none);
    ++dearer;
  }
  EXPECT_GT(cheaper, 10);
  EXPECT_GT(dearer, 10);
}

TEST(CheapestCover, SaysThatItWasCut) {
  RandomCovers random;
  int cut = 0;
  for (int k = 0; k < 50; ++k) {
    const CoverProblem problem = random.next(5, 3, 4);
    const Cover cover = cheapest_cover(problem, {.most_nodes = 1});
    EXPECT_LE(cover.nodes, 1);
    if (cover.end != Cover::StopReason::too_long) continue;
    ++cut;
    const std::optional<double> best = cheapest_of_all(problem);
    if (best) {
      EXPECT_LE(cover.bound, *best + 1e-6);
    }
  }
  EXPECT_GT(cut, 5);
}

}  // namespace
}  // namespace misalign::solver
