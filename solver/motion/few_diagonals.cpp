#include "solver/motion/few_diagonals.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace misalign::solver {
namespace {

constexpr Eigen::Index kMostForEverySet = 16;
constexpr double kNothing = -std::numeric_limits<double>::infinity();

struct SetOfColumns {
  std::uint32_t columns = 0;
  double least = kNothing;
};

// Finds the best set of each size. Each set differs from the one before by one column (Gray's
// order).
std::vector<SetOfColumns> best_of_each_size(const Eigen::MatrixXd& moments,
                                            const std::vector<std::pair<int, int>>& never_both) {
  std::vector<std::uint32_t> pairs;
  for (const auto& [a, b] : never_both) {
    pairs.push_back(std::uint32_t{1} << a | std::uint32_t{1} << b);
  }
  const auto count = static_cast<unsigned>(moments.cols());
  assert(moments.cols() <= kMostForEverySet);
  std::vector<SetOfColumns> best(count + 1);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(moments.rows());
  std::uint32_t set = 0;
  for (std::uint32_t step = 1; step < (std::uint32_t{1} << count); ++step) {
    const int column = std::countr_zero(step);
    set ^= std::uint32_t{1} << column;
    const bool added = (set >> column & 1) != 0;
    sum += (added ? 1.0 : -1.0) * moments.col(column);
    const auto has_both = [&](std::uint32_t pair) { return (set & pair) == pair; };
    if (std::ranges::any_of(pairs, has_both)) continue;
    SetOfColumns& so_far = best[static_cast<std::size_t>(std::popcount(set))];
    if (const double least = sum.minCoeff(); least > so_far.least) so_far = {set, least};
  }
  return best;
}

double least_sum(const Eigen::MatrixXd& moments, const std::vector<int>& columns) {
  return moments(Eigen::all, columns).rowwise().sum().minCoeff();
}

// Lower bound of the number of columns that reach `wanted` in every row: each row alone takes its
// largest.
std::size_t at_least(const Eigen::MatrixXd& moments, double wanted) {
  std::size_t most = 0;
  for (Eigen::Index row = 0; row < moments.rows(); ++row) {
    std::vector<double> largest(moments.cols());
    Eigen::RowVectorXd::Map(largest.data(), moments.cols()) = moments.row(row);
    std::sort(largest.begin(), largest.end(), std::greater<>());
    double sum = 0;
    std::size_t taken = 0;
    while (sum < wanted && taken < largest.size()) sum += largest[taken++];
    most = std::max(most, taken);
  }
  return most;
}

// All columns but one of each pair that may not be together, each time the one whose loss costs
// least.
std::vector<int> without_pairs(const Eigen::MatrixXd& moments,
                               const std::vector<std::pair<int, int>>& never_both) {
  std::vector<bool> is_out(moments.cols());
  Eigen::VectorXd sum = moments.rowwise().sum();
  for (const auto& [a, b] : never_both) {
    if (is_out[a] || is_out[b]) continue;
    const bool first = (sum - moments.col(a)).minCoeff() > (sum - moments.col(b)).minCoeff();
    is_out[first ? a : b] = true;
    sum -= moments.col(first ? a : b);
  }
  std::vector<int> kept;
  for (int k = 0; k < static_cast<int>(moments.cols()); ++k) {
    if (!is_out[k]) kept.push_back(k);
  }
  return kept;
}

// Removes columns one by one, each time the one whose loss costs least: the last set that reaches
// `wanted`, and the next.
std::pair<std::vector<int>, std::vector<int>> thinned_out(const Eigen::MatrixXd& moments,
                                                          std::vector<int> kept, double wanted) {
  Eigen::VectorXd sum = moments(Eigen::all, kept).rowwise().sum();
  while (kept.size() > 1) {
    auto least_missed = kept.end();
    double best = kNothing;
    for (auto column = kept.begin(); column != kept.end(); ++column) {
      const double left = (sum - moments.col(*column)).minCoeff();
      if (left > best) best = left, least_missed = column;
    }
    assert(least_missed != kept.end());
    std::vector<int> fewer = kept;
    fewer.erase(fewer.begin() + (least_missed - kept.begin()));
    if (best < wanted) return {kept, fewer};
    sum -= moments.col(*least_missed);
    kept = std::move(fewer);
  }
  return {kept, {}};
}

std::vector<int> columns_of(const SetOfColumns& set) {
  std::vector<int> columns;
  for (int k = 0; k < static_cast<int>(kMostForEverySet); ++k) {
    if (set.columns >> k & 1) columns.push_back(k);
  }
  return columns;
}

}  // namespace

std::optional<FewDiagonals> few_diagonals(const Eigen::MatrixXd& moments, double share,
                                          const std::vector<std::pair<int, int>>& never_both) {
  assert(moments.rows() > 0 && moments.cols() > 0);
  const double all = moments.rowwise().sum().minCoeff();
  assert(all > 0);
  assert(share > 0 && share <= 1);
  const double wanted = share * all;
  FewDiagonals few;
  if (moments.cols() <= kMostForEverySet) {
    // Sums in Gray's order carry the rounding of many steps: far less than this share.
    constexpr double kRounding = 1e-9;
    bool reaches = false;
    for (const SetOfColumns& set : best_of_each_size(moments, never_both)) {
      if (set.columns == 0 && !few.diagonals.empty()) break;  // larger sets have a pair
      few.fewer = std::move(few.diagonals);
      few.diagonals = columns_of(set);
      reaches = set.least >= wanted * (1 - kRounding);
      if (reaches) break;
    }
    if (!reaches) return {};
    few.proven = true;
  } else {
    std::vector<int> allowed = without_pairs(moments, never_both);
    if (least_sum(moments, allowed) < wanted) return {};
    std::tie(few.diagonals, few.fewer) = thinned_out(moments, std::move(allowed), wanted);
    few.proven = few.diagonals.size() <= at_least(moments, wanted);
  }
  few.share = least_sum(moments, few.diagonals) / all;
  assert(few.share >= (1 - 1e-6) * share);
  few.share_of_fewer = few.fewer.empty() ? 0 : least_sum(moments, few.fewer) / all;
  return few;
}

}  // namespace misalign::solver
