#include "solver/fitting/stock_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "solver/fitting/cheapest_cover.hpp"
#include "solver/fitting/driven_range.hpp"
#include "solver/fitting/link_lengths.hpp"
#include "solver/fitting/stock_drive.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Rows that are there from the start, as a part of the places.
constexpr Index kPlacesPerRow = 30;
// Largest number of types whose sets are tried one by one, and of these sets.
constexpr std::size_t kMostTypes = 3;
constexpr int kMostTypeSets = 5000;

class StockSearch {
 public:
  StockSearch(const StockDrive& drive, const StockOptions& options)
      : drive_(drive), options_(options) {
    for (Index p = 0; p < drive.places(); p += kPlacesPerRow) rows_.insert(p);
    rows_.insert(drive.places() - 1);
    for (int t = 0; t < drive.types(); ++t) {
      for (int d = 0; d < drive.diagonals(); ++d) {
        for (const StockPick& pick : drive.picks(d, t)) all_.push_back({pick, drive.gains(pick)});
      }
    }
    std::set<int> usable;
    for (const Candidate& candidate : all_) usable.insert(candidate.pick.type);
    usable_.assign(usable.begin(), usable.end());
  }

  // The best picks; none where no choice covers the demand.
  std::vector<StockPick> run(const std::vector<StockSpring>& table) {
    table_ = &table;
    if (options_.goal == StockGoal::fewest_types) {
      for (std::size_t count = 1; count <= std::min(kMostTypes, usable_.size()); ++count) {
        const bool all_tried = try_sets(count);
        is_proven_ = is_proven_ && all_tried;
        if (!best_.empty()) return best_;
        if (!all_tried) break;
      }
      if (usable_.size() > kMostTypes) is_proven_ = false;
    }
    try_types(usable_);
    if (best_.empty() && !is_cut_) is_proven_ = true;  // nothing drives, for certain
    return best_;
  }

  // No choice overcomes more at one of the places down to `to_deg`.
  double bound() const {
    Eigen::MatrixXd most = Eigen::MatrixXd::Zero(drive_.places(), drive_.diagonals());
    for (const auto& [pick, gains] : all_) {
      most.col(pick.diagonal) = most.col(pick.diagonal).cwiseMax(gains);
    }
    double least = std::numeric_limits<double>::infinity();
    for (Index p = 0; p < drive_.places(); ++p) {
      if (drive_.counts(p)) least = std::min(least, most.row(p).sum());
    }
    return least;
  }

  double price() const { return price_; }
  bool is_proven() const { return is_proven_; }
  int nodes() const { return nodes_; }
  int pivots() const { return pivots_; }

 private:
  struct Candidate {
    StockPick pick;
    VectorXd gains;
  };

  double price_of(const StockPick& pick) const {
    return (*table_)[static_cast<std::size_t>(pick.type)].price;
  }

  // Tries every set of `count` types. Returns false where there are too many sets.
  bool try_sets(std::size_t count) {
    std::vector<bool> is_in(usable_.size());
    std::fill(is_in.end() - static_cast<std::ptrdiff_t>(count), is_in.end(), true);
    int sets = 0;
    do {
      if (++sets > kMostTypeSets) return false;
      std::vector<int> types;
      for (std::size_t k = 0; k < usable_.size(); ++k) {
        if (is_in[k]) types.push_back(usable_[k]);
      }
      try_types(types);
    } while (std::next_permutation(is_in.begin(), is_in.end()));
    return true;
  }

  // Candidates of these types that no other of their diagonal replaces: dearer, or as dear and
  // weaker at some place.
  std::vector<const Candidate*> candidates_of(const std::vector<int>& types) const {
    std::vector<const Candidate*> left;
    for (const Candidate& candidate : all_) {
      if (std::ranges::count(types, candidate.pick.type) == 0) continue;
      if ((candidate.gains.array() <= 0).all()) continue;
      const auto beats = [&](const Candidate& a, const Candidate& b) {
        return a.pick.diagonal == b.pick.diagonal && price_of(a.pick) <= price_of(b.pick) &&
               (a.gains.array() >= b.gains.array()).all();
      };
      if (std::ranges::any_of(left, [&](const Candidate* c) { return beats(*c, candidate); })) {
        continue;
      }
      std::erase_if(left, [&](const Candidate* c) { return beats(candidate, *c); });
      left.push_back(&candidate);
    }
    return left;
  }

  CoverProblem problem_of(const std::vector<const Candidate*>& candidates) const {
    const std::vector<Index> rows(rows_.begin(), rows_.end());
    CoverProblem problem;
    problem.demand = drive_.demand()(rows);
    std::vector<std::vector<int>> on(static_cast<std::size_t>(drive_.diagonals()));
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      problem.options.push_back({price_of(candidates[k]->pick), candidates[k]->gains(rows)});
      on[static_cast<std::size_t>(candidates[k]->pick.diagonal)].push_back(static_cast<int>(k));
    }
    for (const auto& [a, b] : options_.never_both) {
      std::vector<int> both = on[static_cast<std::size_t>(a)];
      const std::vector<int>& other = on[static_cast<std::size_t>(b)];
      both.insert(both.end(), other.begin(), other.end());
      problem.cliques.push_back(std::move(both));
    }
    problem.cliques.insert(problem.cliques.end(), on.begin(), on.end());
    std::erase_if(problem.cliques, [](const auto& clique) { return clique.empty(); });
    return problem;
  }

  // Keeps the cheapest cover by these types if it is cheaper than the best.
  void try_types(const std::vector<int>& types) {
    const std::vector<const Candidate*> candidates = candidates_of(types);
    for (;;) {
      const CoverProblem problem = problem_of(candidates);
      const double below = best_.empty() ? std::numeric_limits<double>::infinity() : price_;
      const Cover cover =
          cheapest_cover(problem, {std::max(1, options_.most_nodes - nodes_), below});
      nodes_ += cover.nodes;
      pivots_ += cover.pivots;
      if (cover.end == Cover::StopReason::too_long) is_cut_ = true, is_proven_ = false;
      if (cover.chosen.empty()) return;
      std::vector<StockPick> picks;
      for (const int k : cover.chosen) {
        picks.push_back(candidates[static_cast<std::size_t>(k)]->pick);
      }
      if (add_rows(picks)) continue;
      std::ranges::sort(picks, {}, &StockPick::diagonal);
      best_ = std::move(picks);
      price_ = cover.price;
      return;
    }
  }

  // Makes rows of the places at which springs lack most.
  bool add_rows(const std::vector<StockPick>& picks) {
    const VectorXd spare = drive_.gains(picks) - drive_.demand();
    bool is_added = false;
    const Index last = spare.size() - 1;
    for (Index p = 0; p <= last; ++p) {
      const bool is_least =
          spare(p) <= spare(std::max<Index>(p - 1, 0)) && spare(p) <= spare(std::min(p + 1, last));
      if (spare(p) < 0 && is_least) is_added = rows_.insert(p).second || is_added;
    }
    return is_added;
  }

  const StockDrive& drive_;
  const StockOptions& options_;
  const std::vector<StockSpring>* table_ = nullptr;
  std::vector<Candidate> all_;
  std::vector<int> usable_;
  std::set<Index> rows_;
  std::vector<StockPick> best_;
  double price_ = 0;
  bool is_proven_ = true, is_cut_ = false;
  int nodes_ = 0, pivots_ = 0;
};

StockedSpring stocked(const StockDrive& drive, const FoldingWay& way, const StockPick& pick,
                      const StockSpring& spring, double step_mm) {
  StockedSpring stocked{};
  stocked.diagonal = pick.diagonal;
  stocked.type = pick.type;
  stocked.link_mm = pick.link * step_mm;
  stocked.least_mm = drive.least_mm(pick.diagonal);
  stocked.most_mm = drive.most_mm(pick.diagonal);
  const bool pulls = spring.action == SpringAction::pulls;
  const double end_mm = pulls ? stocked.most_mm : stocked.least_mm;
  stocked.largest_force_n = std::abs(spring.force_n(end_mm - stocked.link_mm));
  stocked.linear_free_mm = spring.linear_free_mm() + stocked.link_mm;
  stocked.flat_n = spring.force_n(way.flat_mm()(pick.diagonal) - stocked.link_mm);
  stocked.side = static_cast<int>(sides_of_diagonals(way)(pick.diagonal));
  return stocked;
}

}  // namespace

Springs StockChoice::filling(const Mechanism& mechanism,
                             const std::vector<StockSpring>& table) const {
  Springs filling;
  for (const Diagonal& d : mechanism.diagonals) filling.single.push_back({{d.from, d.to}, 0, {}});
  filling.stiffness_n_per_mm = 0;
  for (const StockedSpring& spring : springs) {
    SingleSpring& single = filling.single[static_cast<std::size_t>(spring.diagonal)];
    single.stiffness_n_per_mm = table[static_cast<std::size_t>(spring.type)].rate_n_per_mm;
    filling.stiffness_n_per_mm = std::max(filling.stiffness_n_per_mm, single.stiffness_n_per_mm);
    if (spring.side * spring.flat_n >= 0) {
      filling.preload.others.push_back({{single.from, single.to}, std::abs(spring.flat_n)});
    } else {
      single.free_mm = spring.linear_free_mm;
    }
  }
  return filling;
}

StudyResult<StockChoice> choose_stock(const Sheet& sheet, const std::vector<StockSpring>& table,
                                      const StockOptions& options) {
  const FoldingWay* const way = sheet.way();
  if (!way) return NoResult::path_lost;
  if (auto fault = driven_range_fault(sheet, *way, options.from_deg, options.to_deg)) {
    return *fault;
  }
  StockChoice choice{};
  choice.options = options;
  choice.from_deg = driven_from_deg(sheet, *way, options.from_deg, options.to_deg);
  const StockDrive drive(*way, choice.from_deg, table, options);
  StockSearch search(drive, options);
  std::vector<StockPick> picks = search.run(table);
  choice.is_proven = search.is_proven();
  choice.nodes = search.nodes();
  choice.pivots = search.pivots();
  choice.price = search.price();
  if (picks.empty()) {
    choice.bound_n_mm_per_mm = search.bound();
    return choice;
  }
  picks = with_few_links(drive, picks);
  const VectorXd overcome = drive.gains(picks);
  choice.static_n_mm_per_mm = std::numeric_limits<double>::infinity();
  for (Index p = 0; p < drive.places(); ++p) {
    if (!drive.counts(p) || overcome(p) >= choice.static_n_mm_per_mm) continue;
    choice.static_n_mm_per_mm = overcome(p);
    choice.weakest_deg = drive.pilot_deg(p);
  }
  for (const StockPick& pick : picks) {
    const StockSpring& type = table[static_cast<std::size_t>(pick.type)];
    choice.springs.push_back(stocked(drive, *way, pick, type, options.links.step_mm));
  }
  return choice;
}

}  // namespace misalign::solver
