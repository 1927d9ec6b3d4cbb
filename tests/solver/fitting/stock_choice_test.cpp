// Springs of a table against every type and every link of every diagonal, by the energies of
// lengths between folded vertices.
#include "solver/fitting/stock_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

constexpr unsigned kStockSeed = 20261129;
constexpr double kFrom_deg = 100;
constexpr double kTo_deg = 2;
// Steps of a sweep: near flat friction overcome grows in proportion to the angle.
constexpr double kSweep_deg = 0.5, kSweepShare = 0.01;

StockSpring pulling(double rate, double free_mm, double longest_mm, double price,
                    double initial_n = 0) {
  return {SpringAction::pulls, rate, free_mm, longest_mm, 0.5, 5, price, initial_n};
}

const std::vector<StockSpring>& stock() {
  static const std::vector<StockSpring> table = {pulling(0.2, 30, 60, 1),
                                                 pulling(0.5, 30, 50, 1.6, 0.4),
                                                 pulling(1.1, 20, 32, 2.5),
                                                 {SpringAction::pushes, 0.6, 40, 25, 0.5, 5, 0.9}};
  return table;
}

class StockedSheets : public testing::Test {
 protected:
  // The next draw that folds to the angle of use.
  Sheet next_sheet() {
    for (;;) {
      Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base_.base.sheet.vertex_count());
      std::uniform_real_distribution<double> shift(-2, 2);
      for (const int vertex : base_.shifted_vertices) {
        for (double& mm : shifts_mm.col(vertex)) mm = shift(random_);
      }
      Sheet sheet(solver_, shifts_mm);
      const FoldingWay* const way = sheet.way();
      if (way && way->end_deg() > kFrom_deg && way->over_folded_deg().value_or(180) > kFrom_deg) {
        return sheet;
      }
    }
  }
  static StockOptions options(double required, bool pushes) {
    StockOptions options;
    options.from_deg = kFrom_deg;
    options.to_deg = kTo_deg;
    options.required_n_mm_per_mm = required;
    options.pushes = pushes;
    options.links = {.step_mm = 4, .least_mm = 8, .largest_force_n = 30};
    options.goal = StockGoal::least_price;
    return options;
  }
  static StockChoice choose(const Sheet& sheet, const StockOptions& options) {
    const StudyResult<StockChoice> result = choose_stock(sheet, stock(), options);
    EXPECT_TRUE(result);
    return *result;
  }

  std::mt19937_64 random_{kStockSeed};
  DrawableSheet base_{4, 4};
  Model model_{base_.base};
  SheetSolver solver_{model_};
};

// Lengths of all diagonals at each angle of a sweep, and the turn of all creases between two.
struct Sweep {
  explicit Sweep(const Sheet& sheet) {
    const std::vector<Crease>& creases = sheet.mechanism().creases;
    for (double deg = kTo_deg; deg <= kFrom_deg + 1e-9;
         deg += std::min(kSweep_deg, kSweepShare * deg)) {
      const Sheet::Pose& pose = sheet.at(deg);
      lengths_mm.push_back(pose.length_mm);
      Eigen::VectorXd turned(std::ssize(creases));
      for (Eigen::Index c = 0; c < turned.size(); ++c) {
        const Crease& crease = creases[static_cast<std::size_t>(c)];
        const double crease_mm = (sheet.point_mm(crease.a) - sheet.point_mm(crease.b)).norm();
        turned(c) = crease_mm * pose.fold_deg(c) * kRadPerDeg;
      }
      if (!folds_mm.empty()) turns_mm.push_back((turned - folds_mm.back()).cwiseAbs().sum());
      folds_mm.push_back(turned);
    }
    const Sheet::Pose& flat = sheet.at(0.02);
    least_mm = most_mm = flat.length_mm;
    for (const Eigen::VectorXd& at_mm : lengths_mm) {
      least_mm = least_mm.cwiseMin(at_mm);
      most_mm = most_mm.cwiseMax(at_mm);
    }
  }
  std::vector<Eigen::VectorXd> lengths_mm, folds_mm;
  std::vector<double> turns_mm;
  Eigen::VectorXd least_mm, most_mm;
};

// A way to fill one diagonal: energy released over the turn in each step of a sweep.
struct Way {
  int type = -1;
  double link_mm = 0, price = 0;
  std::vector<double> overcome;
};

bool may_be_used(const StockSpring& spring, double shortest_mm, double longest_mm) {
  const bool pulls = spring.action == SpringAction::pulls;
  if (pulls ? shortest_mm < spring.free_mm || longest_mm > spring.limit_mm
            : longest_mm > spring.free_mm || shortest_mm < spring.limit_mm) {
    return false;
  }
  const double largest_n =
      pulls ? spring.initial_n + spring.rate_n_per_mm * (longest_mm - spring.free_mm)
            : spring.rate_n_per_mm * (spring.free_mm - shortest_mm);
  return largest_n <= 30;
}

std::vector<Way> ways_of(const Sweep& sweep, Eigen::Index d, bool pushes) {
  std::vector<Way> ways = {{-1, 0, 0, std::vector<double>(sweep.turns_mm.size(), 0.0)}};
  for (int t = 0; t < std::ssize(stock()); ++t) {
    const StockSpring& spring = stock()[static_cast<std::size_t>(t)];
    if (spring.action == SpringAction::pushes && !pushes) continue;
    for (double link_mm = 8; link_mm < 200; link_mm += 4) {
      if (!may_be_used(spring, sweep.least_mm(d) - link_mm, sweep.most_mm(d) - link_mm)) continue;
      Way way{t, link_mm, spring.price, {}};
      const auto energy = [&](std::size_t k) {
        const double longer_mm = sweep.lengths_mm[k](d) - link_mm - spring.free_mm;
        return spring.initial_n * longer_mm + spring.rate_n_per_mm / 2 * longer_mm * longer_mm;
      };
      for (std::size_t k = 0; k + 1 < sweep.lengths_mm.size(); ++k) {
        way.overcome.push_back((energy(k + 1) - energy(k)) / sweep.turns_mm[k]);
      }
      ways.push_back(std::move(way));
    }
  }
  return ways;
}

double least_overcome(const std::vector<const Way*>& ways) {
  double least = 1e300;
  for (std::size_t k = 0; k < ways[0]->overcome.size(); ++k) {
    double sum = 0;
    for (const Way* const way : ways) sum += way->overcome[k];
    least = std::min(least, sum);
  }
  return least;
}

// Calls `see` with every choice of one way a diagonal.
void each_choice(const std::vector<std::vector<Way>>& ways, std::vector<const Way*>& chosen,
                 const auto& see) {
  if (chosen.size() == ways.size()) return see(chosen);
  for (const Way& way : ways[chosen.size()]) {
    chosen.push_back(&way);
    each_choice(ways, chosen, see);
    chosen.pop_back();
  }
}

std::vector<std::vector<Way>> all_ways(const Sweep& sweep, bool pushes) {
  std::vector<std::vector<Way>> ways;
  for (Eigen::Index d = 0; d < sweep.least_mm.size(); ++d) {
    ways.push_back(ways_of(sweep, d, pushes));
  }
  return ways;
}

// The least price that overcomes a friction; infinite where none does.
double least_price(const std::vector<std::vector<Way>>& ways, double required) {
  double best = std::numeric_limits<double>::infinity();
  std::vector<const Way*> chosen;
  each_choice(ways, chosen, [&](const std::vector<const Way*>& all) {
    double price = 0;
    for (const Way* const way : all) price += way->price;
    if (price < best && least_overcome(all) >= required) best = price;
  });
  return best;
}

double most_overcome(const std::vector<std::vector<Way>>& ways) {
  double most = 0;
  std::vector<const Way*> chosen;
  each_choice(ways, chosen, [&](const auto& all) { most = std::max(most, least_overcome(all)); });
  return most;
}

// The choice requires a thousandth more between its places; a sweep takes means over its steps,
// which at the smallest angles differ by half a hundredth.
TEST_F(StockedSheets, CostTheLeastOfAllChoices) {
  int driven = 0, not_driven = 0, of_push = 0;
  for (int k = 0; k < 6; ++k) {
    const bool pushes = k % 2 == 1;
    const Sheet sheet = next_sheet();
    const auto ways = all_ways(Sweep(sheet), pushes);
    const double most = most_overcome(ways);
    for (const double share : {0.1, 0.5, 0.9, 1.2}) {
      const double required = share * std::max(most, 1e-6);
      const StockChoice choice = choose(sheet, options(required, pushes));
      EXPECT_TRUE(choice.is_proven);
      const double least = least_price(ways, 0.99 * required);
      const double largest = least_price(ways, 1.01 * required);
      if (!choice.drives()) {
        ++not_driven;
        EXPECT_EQ(largest, std::numeric_limits<double>::infinity());
        EXPECT_GE(choice.bound_n_mm_per_mm, most * (1 - 1e-2));
        continue;
      }
      ++driven;
      EXPECT_GE(choice.price, least - 1e-9) << "seed " << kStockSeed << ", sheet " << k;
      EXPECT_LE(choice.price, largest + 1e-9) << "seed " << kStockSeed << ", sheet " << k;
      for (const StockedSpring& spring : choice.springs) of_push += spring.type == 3;
    }
  }
  EXPECT_GE(driven, 6);
  EXPECT_GE(not_driven, 6);
  EXPECT_GE(of_push, 1);
}

// The way of each chosen spring, of those that may be used.
std::vector<const Way*> chosen_ways(const std::vector<std::vector<Way>>& ways,
                                    const StockChoice& choice) {
  std::vector<const Way*> chosen;
  for (const auto& of_diagonal : ways) chosen.push_back(&of_diagonal.front());
  for (const StockedSpring& spring : choice.springs) {
    const auto& all = ways[static_cast<std::size_t>(spring.diagonal)];
    const auto at = std::ranges::find_if(all, [&](const Way& way) {
      return way.type == spring.type && std::abs(way.link_mm - spring.link_mm) < 1e-9;
    });
    EXPECT_NE(at, all.end()) << "it may not be used";
    if (at != all.end()) chosen[static_cast<std::size_t>(spring.diagonal)] = &*at;
  }
  return chosen;
}

// The least number of lengths of links that the same types on the same diagonals can have.
std::size_t least_links(const std::vector<std::vector<Way>>& ways,
                        const std::vector<const Way*>& chosen, double required) {
  std::vector<std::vector<Way>> of_types(ways.size());
  for (std::size_t d = 0; d < ways.size(); ++d) {
    std::ranges::copy_if(ways[d], std::back_inserter(of_types[d]),
                         [&](const Way& way) { return way.type == chosen[d]->type; });
  }
  std::size_t least = ways.size();
  std::vector<const Way*> picked;
  each_choice(of_types, picked, [&](const std::vector<const Way*>& all) {
    std::set<double> links;
    for (const Way* const way : all) {
      if (way->type >= 0) links.insert(way->link_mm);
    }
    if (links.size() < least && least_overcome(all) >= required) least = links.size();
  });
  return least;
}

// The most that is overcome with all links of one length a step longer; 0 where one may not be.
double with_longer_links(const std::vector<std::vector<Way>>& ways,
                         const std::vector<const Way*>& chosen) {
  double most = 0;
  for (const Way* const one : chosen) {
    if (one->type < 0) continue;
    std::vector<const Way*> longer = chosen;
    bool may = true;
    for (std::size_t d = 0; d < ways.size(); ++d) {
      if (longer[d]->type < 0 || longer[d]->link_mm != one->link_mm) continue;
      const auto at = std::ranges::find_if(ways[d], [&](const Way& way) {
        return way.type == chosen[d]->type && way.link_mm == one->link_mm + 4;
      });
      may = may && at != ways[d].end();
      if (may) longer[d] = &*at;
    }
    if (may) most = std::max(most, least_overcome(longer));
  }
  return most;
}

TEST_F(StockedSheets, OvercomeTheFrictionWithTheFewestLinks) {
  int driven = 0, shared = 0;
  for (int k = 0; k < 6; ++k) {
    const Sheet sheet = next_sheet();
    const auto ways = all_ways(Sweep(sheet), false);
    const double most = most_overcome(ways);
    if (most < 1e-6) continue;
    for (const double share : {0.2, 0.4, 0.6}) {
      const double required = share * most;
      const StockChoice choice = choose(sheet, options(required, false));
      ASSERT_TRUE(choice.drives());
      ++driven;
      const auto chosen = chosen_ways(ways, choice);
      const double overcome = least_overcome(chosen);
      // Means over the steps of a sweep are near the least.
      EXPECT_GE(overcome, 0.999 * required);
      EXPECT_NEAR(overcome, choice.static_n_mm_per_mm, 0.02 * overcome);
      std::set<double> links;
      for (const StockedSpring& spring : choice.springs) links.insert(spring.link_mm);
      EXPECT_GE(links.size(), least_links(ways, chosen, 0.99 * required));
      EXPECT_LE(links.size(), least_links(ways, chosen, 1.01 * required));
      EXPECT_LE(with_longer_links(ways, chosen), 1.01 * required);
      shared += links.size() < choice.springs.size();
    }
  }
  EXPECT_GE(driven, 6);
  EXPECT_GE(shared, 1);
}

TEST_F(StockedSheets, HaveFewestTypesAndTouchNowhereForbidden) {
  for (int k = 0; k < 6; ++k) {
    const Sheet sheet = next_sheet();
    const auto ways = all_ways(Sweep(sheet), false);
    const double required = 0.3 * most_overcome(ways);
    if (required < 1e-6) continue;
    StockOptions of_types = options(required, false);
    of_types.goal = StockGoal::fewest_types;
    const StockChoice few = choose(sheet, of_types);
    const StockChoice cheap = choose(sheet, options(required, false));
    ASSERT_TRUE(few.drives());
    EXPECT_GE(few.price, cheap.price - 1e-9);
    std::set<int> types;
    for (const StockedSpring& spring : few.springs) types.insert(spring.type);
    // The cheapest of each type alone.
    double best = std::numeric_limits<double>::infinity(), nearly = best;
    for (int t = 0; t < 3; ++t) {
      auto of_type = ways;
      for (auto& all : of_type) {
        std::erase_if(all, [&](const Way& way) { return way.type >= 0 && way.type != t; });
      }
      best = std::min(best, least_price(of_type, 1.01 * required));
      nearly = std::min(nearly, least_price(of_type, 0.99 * required));
    }
    if (best < std::numeric_limits<double>::infinity()) {
      EXPECT_EQ(types.size(), 1U);
      EXPECT_LE(few.price, best + 1e-9);
      EXPECT_GE(few.price, nearly - 1e-9);
    }
    if (few.springs.size() < 2) continue;
    of_types.never_both = {{few.springs[0].diagonal, few.springs[1].diagonal}};
    const StockChoice apart = choose(sheet, of_types);
    int both = 0;
    for (const StockedSpring& spring : apart.springs) {
      both +=
          spring.diagonal == few.springs[0].diagonal || spring.diagonal == few.springs[1].diagonal;
    }
    EXPECT_LE(both, 1);
  }
}

// The links of a spring are the whole steps at which it may be used, one by one.
TEST(StockLinks, AreThoseAtWhichTheSpringMayBeUsed) {
  std::mt19937 random(kStockSeed);
  std::uniform_real_distribution<double> shortest(60, 110), stroke(0, 15);
  int some = 0;
  for (int k = 0; k < 300; ++k) {
    const StockSpring& spring = stock()[static_cast<std::size_t>(k) % stock().size()];
    const double least_mm = shortest(random), most_mm = least_mm + stroke(random);
    const LinkLimits limits{.step_mm = 3, .least_mm = 10, .largest_force_n = 8};
    const LinkRange range = links_of(spring, least_mm, most_mm, limits);
    for (int link = 0; link < 60; ++link) {
      const double low_mm = least_mm - 3 * link, high_mm = most_mm - 3 * link;
      const double end_mm = spring.action == SpringAction::pulls ? high_mm : low_mm;
      const bool is_weak = std::abs(spring.force_n(end_mm)) <= 8;
      const bool may = 3 * link >= 10 && may_be_used(spring, low_mm, high_mm) && is_weak;
      EXPECT_EQ(range.contains(link), may) << "seed " << kStockSeed << ", " << k << ", " << link;
      some += may;
    }
  }
  EXPECT_GT(some, 100);
}

}  // namespace
}  // namespace misalign::solver
