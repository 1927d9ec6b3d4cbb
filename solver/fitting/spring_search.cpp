#include "solver/fitting/spring_search.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <queue>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Rates below this share of the largest are none, and differ from one of the list by rounding.
constexpr double kSame = 1e-7;

// A part of the search: narrower limits of springs, and those that must be there.
struct Node {
  std::vector<SpringRange> springs;
  std::vector<bool> present;
  double bound;
  bool operator<(const Node& other) const { return bound < other.bound; }
};

void take_out(SpringRange& spring) { spring.least_n_per_mm = spring.most_n_per_mm = 0; }

class Search {
 public:
  Search(SpringProgram& program, const SpringRules& rules, const SpringSearchOptions& options)
      : program_(program), rules_(rules), options_(options), largest_(std::ssize(rules.springs)) {
    for (Index d = 0; d < largest_.size(); ++d) largest_(d) = rules.springs[at(d)].most_n_per_mm;
    assert(std::ranges::is_sorted(rules.rates_n_per_mm));
    best_.rates_n_per_mm.setZero(largest_.size());
    best_.free_mm.setZero(largest_.size());
    for (Index d = 0; d < largest_.size(); ++d)
      best_.free_mm(d) = rules.springs[at(d)].least_free_mm;
  }

  SpringSearch run() {
    const int programs = program_.programs();
    visit({rules_.springs, std::vector<bool>(rules_.springs.size()), 0});
    const double relaxed = last_bound_;
    int nodes = 1;
    while (!open_.empty() && !is_done(open_.top().bound) &&
           program_.programs() - programs < options_.most_programs) {
      const Node node = open_.top();
      open_.pop();
      visit(node);
      ++nodes;
    }
    const double bound =
        std::max(best_.static_n_mm_per_mm, open_.empty() ? 0.0 : open_.top().bound);
    return {best_, std::max(bound, lost_), relaxed, nodes};
  }

 private:
  static std::size_t at(Index d) { return static_cast<std::size_t>(d); }

  bool is_done(double bound) const {
    const double wanted = options_.wanted_n_mm_per_mm.value_or(bound);
    return bound <= best_.static_n_mm_per_mm * (1 + options_.gap) ||
           (options_.wanted_n_mm_per_mm && (best_.static_n_mm_per_mm >= wanted || bound < wanted));
  }

  // Takes out springs that others exclude. Returns false where no springs are possible.
  bool propagate(Node& node) const {
    for (const auto& [a, b] : rules_.never_both) {
      if (node.present[at(a)] && node.present[at(b)]) return false;
      if (node.present[at(a)]) take_out(node.springs[at(b)]);
      if (node.present[at(b)]) take_out(node.springs[at(a)]);
    }
    if (!rules_.most_springs) return true;
    const auto count = std::ranges::count(node.present, true);
    if (count > *rules_.most_springs) return false;
    if (count < *rules_.most_springs) return true;
    for (std::size_t d = 0; d < node.springs.size(); ++d) {
      if (!node.present[d]) take_out(node.springs[d]);
    }
    return true;
  }

  std::vector<SpringGroup> groups_of(const Node& node) const {
    std::vector<SpringGroup> groups;
    const auto is_open = [&](int d) {
      return !node.present[at(d)] && node.springs[at(d)].most_n_per_mm > 0;
    };
    for (const auto& [a, b] : rules_.never_both) {
      if (is_open(a) && is_open(b)) groups.push_back({{a, b}, 1});
    }
    if (rules_.most_springs) {
      SpringGroup all{
          {}, static_cast<double>(*rules_.most_springs - std::ranges::count(node.present, true))};
      for (int d = 0; d < static_cast<int>(node.springs.size()); ++d) {
        if (is_open(d)) all.diagonals.push_back(d);
      }
      if (!all.diagonals.empty()) groups.push_back(std::move(all));
    }
    return groups;
  }

  // The part of a largest rate that a spring has.
  double share(const ProgrammedSprings& springs, Index d) const {
    return largest_(d) > 0 ? springs.rates_n_per_mm(d) / largest_(d) : 0;
  }

  // Rounds a relaxed solution to springs that the rules allow, and solves for the rest.
  void round(const ProgrammedSprings& relaxed) {
    std::vector<SpringRange> springs = rules_.springs;
    std::vector<Index> order(springs.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::stable_sort(
        order, [&](Index a, Index b) { return share(relaxed, a) > share(relaxed, b); });
    std::vector<bool> taken(springs.size());
    int count = 0;
    for (const Index d : order) {
      const double rate = nearest(relaxed.rates_n_per_mm(d), largest_(d));
      const auto excludes = [&](const std::pair<int, int>& pair) {
        return (pair.first == d && taken[at(pair.second)]) ||
               (pair.second == d && taken[at(pair.first)]);
      };
      const bool is_free = (!rules_.most_springs || count < *rules_.most_springs) &&
                           std::ranges::none_of(rules_.never_both, excludes);
      if (rate <= kSame * largest_(d) || !is_free) {
        take_out(springs[at(d)]);
        continue;
      }
      taken[at(d)] = true;
      ++count;
      if (!rules_.rates_n_per_mm.empty()) {
        springs[at(d)].least_n_per_mm = springs[at(d)].most_n_per_mm = rate;
      }
    }
    keep(program_.solve(springs, {}, largest_));
  }

  // The nearest rate of the list, or none; the rate itself without a list.
  double nearest(double rate, double largest) const {
    double best = rules_.rates_n_per_mm.empty() ? rate : 0;
    for (const double other : rules_.rates_n_per_mm) {
      if (other <= largest && std::abs(other - rate) <= std::abs(best - rate)) best = other;
    }
    return best;
  }

  void keep(ProgrammedSprings springs) {
    if (springs.static_n_mm_per_mm > best_.static_n_mm_per_mm) best_ = std::move(springs);
  }

  void visit(Node node) {
    if (!propagate(node)) return;
    const std::vector<SpringGroup> groups = groups_of(node);
    const ProgrammedSprings relaxed = program_.solve(node.springs, groups, largest_);
    node.bound = last_bound_ = relaxed.bound_n_mm_per_mm;
    if (is_pruned(node.bound)) return;
    if (branch_on_presence(node, relaxed) || branch_on_rate(node, relaxed)) return round(relaxed);
    // The relaxed springs obey the rules.
    if (rules_.rates_n_per_mm.empty())
      keep(relaxed);
    else
      round(relaxed);
    // Rounding that lost something is said in the bound.
    lost_ = std::max(lost_, node.bound);
  }

  bool is_pruned(double bound) const {
    return bound <= best_.static_n_mm_per_mm ||
           (options_.wanted_n_mm_per_mm && bound < *options_.wanted_n_mm_per_mm);
  }

  void open(const Node& parent, Index d, const SpringRange& spring, bool is_present) {
    Node child = parent;
    child.springs[at(d)] = spring;
    child.present[at(d)] = child.present[at(d)] || is_present;
    open_.push(std::move(child));
  }

  bool branch_on_presence(const Node& node, const ProgrammedSprings& relaxed) {
    const auto carries = [&](Index d) { return share(relaxed, d) > kSame; };
    Index chosen = -1;
    const auto consider = [&](Index d) {
      if (!carries(d) || node.present[at(d)]) return;
      if (chosen < 0 || share(relaxed, d) > share(relaxed, chosen)) chosen = d;
    };
    for (const auto& [a, b] : rules_.never_both) {
      if (!carries(a) || !carries(b)) continue;
      consider(a);
      consider(b);
    }
    int count = 0;
    for (Index d = 0; d < largest_.size(); ++d) count += carries(d) ? 1 : 0;
    if (chosen < 0 && rules_.most_springs && count > *rules_.most_springs) {
      for (Index d = 0; d < largest_.size(); ++d) consider(d);
    }
    if (chosen < 0) return false;
    SpringRange absent = node.springs[at(chosen)], present = absent;
    take_out(absent);
    if (!rules_.rates_n_per_mm.empty()) {
      present.least_n_per_mm = std::max(present.least_n_per_mm, rules_.rates_n_per_mm.front());
    }
    open(node, chosen, absent, false);
    open(node, chosen, present, true);
    return true;
  }

  // Branches on the rate that is farthest from the list.
  bool branch_on_rate(const Node& node, const ProgrammedSprings& relaxed) {
    if (rules_.rates_n_per_mm.empty()) return false;
    Index chosen = -1;
    double farthest = kSame;
    for (Index d = 0; d < largest_.size(); ++d) {
      if (largest_(d) <= 0) continue;
      const double rate = relaxed.rates_n_per_mm(d);
      const double off = std::abs(nearest(rate, largest_(d)) - rate) / largest_(d);
      if (off > farthest) farthest = off, chosen = d;
    }
    if (chosen < 0) return false;
    const double rate = relaxed.rates_n_per_mm(chosen);
    SpringRange below = node.springs[at(chosen)], above = below;
    below.most_n_per_mm = 0;
    for (const double other : rules_.rates_n_per_mm) {
      if (other < rate) below.most_n_per_mm = other;
    }
    above.least_n_per_mm = *std::ranges::upper_bound(rules_.rates_n_per_mm, rate);
    if (below.most_n_per_mm >= below.least_n_per_mm) open(node, chosen, below, false);
    if (above.least_n_per_mm <= above.most_n_per_mm) open(node, chosen, above, true);
    return true;
  }

  SpringProgram& program_;
  const SpringRules& rules_;
  const SpringSearchOptions& options_;
  VectorXd largest_;
  ProgrammedSprings best_;
  std::priority_queue<Node> open_;
  double last_bound_ = 0, lost_ = 0;
};

}  // namespace

SpringSearch search_springs(SpringProgram& program, const SpringRules& rules,
                            const SpringSearchOptions& options) {
  return Search(program, rules, options).run();
}

}  // namespace misalign::solver
