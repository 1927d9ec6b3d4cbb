#include "solver/fitting/cheapest_cover.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <queue>

#include "solver/linear/simplex.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// A row is covered, and a price is no lower, to this share: ten times the linear program's.
constexpr double kCovered = 1e-8;

enum class Take : signed char { open, taken, left };

// A part of the search: options that are decided.
struct CoverNode {
  std::vector<Take> take;
  double bound;
  bool operator<(const CoverNode& other) const { return bound > other.bound; }  // cheapest first
};

class CoverTree {
 public:
  CoverTree(const CoverProblem& problem, const CoverSearch& search)
      : problem_(problem), search_(search), cliques_of_(problem.options.size()) {
    for (std::size_t q = 0; q < problem.cliques.size(); ++q) {
      for (const int option : problem.cliques[q]) {
        cliques_of_[at(option)].push_back(static_cast<int>(q));
      }
    }
    unit_ = problem.demand.cwiseAbs();
    for (const CoverOption& option : problem.options) {
      assert(option.price >= 0 && option.gains.size() == unit_.size());
      unit_ = unit_.cwiseMax(option.gains.cwiseAbs());
    }
    unit_ = (unit_.array() > 0).select(unit_, 1);
    for (const CoverOption& option : problem.options) {
      most_price_ = std::max(most_price_, option.price);
    }
    if (most_price_ == 0) most_price_ = 1;
  }

  Cover run() {
    visit({std::vector<Take>(problem_.options.size(), Take::open), 0});
    while (!open_.empty() && open_.top().bound < limit() && cover_.nodes < search_.most_nodes) {
      const CoverNode node = open_.top();
      open_.pop();
      visit(node);
    }
    const bool is_cut = !open_.empty() && open_.top().bound < limit();
    cover_.bound = is_cut ? open_.top().bound : cover_.price;
    if (is_cut) {
      cover_.end = Cover::StopReason::too_long;
    } else if (is_covered_) {
      cover_.end = Cover::StopReason::optimal;
    }
    return std::move(cover_);
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  // Bounds at or above this lead to no better cover.
  double limit() const {
    return is_covered_ ? cover_.price - kCovered * most_price_ : search_.price_below;
  }

  void take(CoverNode& node, int option) const {
    for (const int q : cliques_of_[at(option)]) {
      for (const int other : problem_.cliques[at(q)]) node.take[at(other)] = Take::left;
    }
    node.take[at(option)] = Take::taken;
  }

  // The demand that is left, in units of the rows, and the price of what is taken.
  VectorXd left_of(const CoverNode& node, double& price) const {
    VectorXd left = problem_.demand;
    price = 0;
    for (std::size_t o = 0; o < node.take.size(); ++o) {
      if (node.take[o] != Take::taken) continue;
      left -= problem_.options[o].gains;
      price += problem_.options[o].price;
    }
    return left.cwiseQuotient(unit_);
  }

  // The dual: prices of the rows' units, and rents of the cliques.
  LinearProgram dual_of(const std::vector<int>& open, const VectorXd& left) const {
    const Index rows = left.size(), cliques = std::ssize(problem_.cliques);
    LinearProgram dual;
    dual.rows.setZero(std::ssize(open), rows + cliques);
    dual.bounds.resize(std::ssize(open));
    dual.gain.setConstant(rows + cliques, -1);
    dual.gain.head(rows) = left;
    for (Index k = 0; k < std::ssize(open); ++k) {
      const int option = open[static_cast<std::size_t>(k)];
      dual.rows.row(k).head(rows) = problem_.options[at(option)].gains.cwiseQuotient(unit_);
      for (const int q : cliques_of_[at(option)]) dual.rows(k, rows + q) = -1;
      dual.bounds(k) = problem_.options[at(option)].price / most_price_;
    }
    return dual;
  }

  void visit(CoverNode node) {
    ++cover_.nodes;
    double price = 0;
    const VectorXd left = left_of(node, price);
    if ((left.array() <= kCovered).all()) return keep(node, price);
    std::vector<int> open;
    for (std::size_t o = 0; o < node.take.size(); ++o) {
      if (node.take[o] == Take::open) open.push_back(static_cast<int>(o));
    }
    const LinearOptimum optimum = maximize(dual_of(open, left));
    cover_.pivots += optimum.pivots;
    if (optimum.end == LinearOptimum::StopReason::unbounded) return;  // nothing covers the rest
    node.bound = std::max(node.bound, price + most_price_ * optimum.value);
    if (node.bound >= limit()) return;
    round(node, open, optimum.price);
    if (node.bound >= limit()) return;
    if (open.empty()) return;
    // The option whose share is nearest to a half decides.
    Index nearest = 0;
    (optimum.price.head(std::ssize(open)).array() - 0.5).abs().minCoeff(&nearest);
    const int chosen = open[static_cast<std::size_t>(nearest)];
    CoverNode without = node;
    without.take[at(chosen)] = Take::left;
    open_.push(std::move(without));
    take(node, chosen);
    open_.push(std::move(node));
  }

  // Takes options by their shares until the demand is covered, then leaves out those that it does
  // not need.
  void round(const CoverNode& node, const std::vector<int>& open, const VectorXd& shares) {
    std::vector<std::size_t> order(open.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return shares(static_cast<Index>(a)) > shares(static_cast<Index>(b));
    });
    CoverNode rounded = node;
    double price = 0;
    std::vector<int> added;
    for (const std::size_t k : order) {
      if ((left_of(rounded, price).array() <= kCovered).all()) break;
      if (rounded.take[at(open[k])] != Take::open) continue;
      take(rounded, open[k]);
      added.push_back(open[k]);
    }
    if ((left_of(rounded, price).array() > kCovered).any()) return;
    for (const int option : added) {
      rounded.take[at(option)] = Take::left;
      if ((left_of(rounded, price).array() > kCovered).any()) {
        rounded.take[at(option)] = Take::taken;
      }
    }
    left_of(rounded, price);
    keep(rounded, price);
  }

  void keep(const CoverNode& node, double price) {
    if (price >= limit()) return;
    is_covered_ = true;
    cover_.price = price;
    cover_.chosen.clear();
    for (std::size_t o = 0; o < node.take.size(); ++o) {
      if (node.take[o] == Take::taken) cover_.chosen.push_back(static_cast<int>(o));
    }
  }

  const CoverProblem& problem_;
  const CoverSearch& search_;
  std::vector<std::vector<int>> cliques_of_;
  VectorXd unit_;  // per row, the largest gain or demand
  double most_price_ = 0;
  std::priority_queue<CoverNode> open_;
  Cover cover_;
  bool is_covered_ = false;
};

}  // namespace

Cover cheapest_cover(const CoverProblem& problem, const CoverSearch& search) {
  return CoverTree(problem, search).run();
}

}  // namespace misalign::solver
