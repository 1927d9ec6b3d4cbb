#include "solver/fitting/spring_choice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/fitting/driven_range.hpp"
#include "solver/fitting/spring_search.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Frictions below this share of that of one largest spring are rounding.
constexpr double kNoFriction = 1e-9;
constexpr int kHalvings = 12;

std::optional<OptionFault> fault_of(const Sheet& sheet, const FoldingWay& way,
                                    const SpringChoiceOptions& options) {
  if (auto fault = driven_range_fault(sheet, way, options.from_deg, options.to_deg)) return fault;
  if (!options.fewest_margin || options.friction_n_mm_per_mm > 0) return {};
  return OptionFault{"fewest", shown("%.10g", *options.fewest_margin),
                     "is a margin over the friction of the creases, which is 0", "give a friction"};
}

SpringRules rules_of(const FoldingWay& way, const SpringProgram& program,
                     const SpringChoiceOptions& options) {
  SpringRules rules;
  double most = options.most_rate_n_per_mm;
  for (const double rate : options.rates_n_per_mm) {
    if (rate <= most) rules.rates_n_per_mm.push_back(rate);
  }
  if (!options.rates_n_per_mm.empty()) {
    most = rules.rates_n_per_mm.empty() ? 0 : rules.rates_n_per_mm.back();
  }
  VectorXd shortest_mm = way.flat_mm();
  for (const DrivenPlace& place : program.places()) {
    shortest_mm = shortest_mm.cwiseMin(place.length_mm);
  }
  for (Index d = 0; d < way.flat_mm().size(); ++d) {
    const double flat_mm = way.flat_mm()(d);
    SpringRange spring{0, most, flat_mm * (1 - options.free_within),
                       flat_mm * (1 + options.free_within)};
    if (options.pull_only) spring.most_free_mm = std::min(spring.most_free_mm, shortest_mm(d));
    if (spring.most_free_mm < spring.least_free_mm) {
      spring.most_free_mm = spring.least_free_mm;
      spring.most_n_per_mm = 0;
    }
    rules.springs.push_back(spring);
  }
  rules.never_both = options.never_both;
  rules.most_springs = options.most_springs;
  for (int d = 0; options.one_a_hole && d + 1 < std::ssize(rules.springs); d += 2) {
    rules.never_both.emplace_back(d, d + 1);
  }
  return rules;
}

// Friction below which no springs drive.
double no_friction(const SpringProgram& program, const SpringRules& rules) {
  double largest = 0;
  for (const DrivenPlace& place : program.places()) {
    for (Index d = 0; d < place.length_mm.size(); ++d) {
      const SpringRange& spring = rules.springs[static_cast<std::size_t>(d)];
      const double longer_mm = std::abs(place.length_mm(d) - spring.least_free_mm);
      largest = std::max(largest, spring.most_n_per_mm * longer_mm * std::abs(place.slope_mm(d)) /
                                      place.turning_mm);
    }
  }
  return kNoFriction * largest;
}

bool is_driven(const FoldingWay& way, double from_deg, const SpringChoiceOptions& options) {
  SpringProgram program(way, from_deg, options.to_deg);
  const SpringRules rules = rules_of(way, program, options);
  const SpringSearch found = search_springs(program, rules, {1.0, {}, options.most_programs});
  return found.best.static_n_mm_per_mm > no_friction(program, rules);
}

// The largest angle from which springs drive the sheet, to a 2^-12 of the angle of use.
double largest_driven_deg(const FoldingWay& way, double from_deg,
                          const SpringChoiceOptions& options) {
  double driven_deg = 0, not_driven_deg = from_deg;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle_deg = (driven_deg + not_driven_deg) / 2;
    const bool is_below = middle_deg <= options.to_deg;
    if (is_below && driven_deg == 0 && k > 0 && not_driven_deg <= options.to_deg) break;
    (is_below || is_driven(way, middle_deg, options) ? driven_deg : not_driven_deg) = middle_deg;
  }
  return driven_deg <= options.to_deg ? 0 : driven_deg;
}

struct FewestSprings {
  SpringSearch search;
  bool is_proven;
};

// Raises the number of springs until they overcome the wanted friction; then seeks the best of that
// number. None: even all springs do not.
std::optional<FewestSprings> fewest(SpringProgram& program, SpringRules rules,
                                    double wanted_n_mm_per_mm, int most_programs) {
  bool is_proven = true;
  const int most = rules.most_springs.value_or(static_cast<int>(rules.springs.size()));
  for (int count = 1; count <= most; ++count) {
    rules.most_springs = count;
    const int before = program.programs();
    SpringSearch found = search_springs(
        program, rules, {.wanted_n_mm_per_mm = wanted_n_mm_per_mm, .most_programs = most_programs});
    if (found.best.static_n_mm_per_mm >= wanted_n_mm_per_mm) {
      SpringSearch best = search_springs(
          program, rules, {.wanted_n_mm_per_mm = {}, .most_programs = most_programs});
      best.nodes += found.nodes;
      if (best.best.static_n_mm_per_mm < wanted_n_mm_per_mm) best.best = found.best;
      return FewestSprings{std::move(best), is_proven};
    }
    is_proven = is_proven && program.programs() - before < most_programs;
  }
  return {};
}

// Springs of the search alone, with their rates free to change.
SpringRules rules_of_chosen(const SpringRules& rules, const ProgrammedSprings& best) {
  SpringRules chosen = rules;
  for (std::size_t d = 0; d < chosen.springs.size(); ++d) {
    SpringRange& spring = chosen.springs[d];
    const double rate = best.rates_n_per_mm(static_cast<Index>(d));
    if (rate <= 0) spring.most_n_per_mm = 0;
    if (!rules.rates_n_per_mm.empty()) spring.least_n_per_mm = spring.most_n_per_mm = rate;
  }
  return chosen;
}

// Gives as many springs as possible one free length, then as many of the others, and so on: each
// time the length that most of them can share, while the friction does not fall below `wanted`.
ProgrammedSprings with_few_lengths(SpringProgram& program, const SpringRules& rules,
                                   const ProgrammedSprings& best, double wanted) {
  SpringRules fixed = rules_of_chosen(rules, best);
  VectorXd largest(best.rates_n_per_mm.size());
  for (Index d = 0; d < largest.size(); ++d) {
    largest(d) = rules.springs[static_cast<std::size_t>(d)].most_n_per_mm;
  }
  ProgrammedSprings kept = best;
  std::vector<std::size_t> left;
  for (std::size_t d = 0; d < fixed.springs.size(); ++d) {
    if (fixed.springs[d].most_n_per_mm > 0) left.push_back(d);
  }
  while (!left.empty()) {
    // Springs join one by one the length of the one whose length most others can have.
    std::vector<std::size_t> most_joined;
    SpringRules with_most = fixed;
    ProgrammedSprings found = kept;
    for (const std::size_t leader : left) {
      const double free_mm = kept.free_mm(static_cast<Index>(leader));
      SpringRules with = fixed;
      std::vector<std::size_t> joined;
      ProgrammedSprings latest = kept;
      for (const std::size_t d : left) {
        const SpringRange before = with.springs[d];
        if (free_mm < before.least_free_mm || free_mm > before.most_free_mm) continue;
        with.springs[d].least_free_mm = with.springs[d].most_free_mm = free_mm;
        const ProgrammedSprings solved = program.solve(with.springs, {}, largest);
        if (solved.static_n_mm_per_mm >= wanted) {
          joined.push_back(d);
          latest = solved;
        } else {
          with.springs[d] = before;
        }
      }
      if (joined.size() > most_joined.size()) {
        most_joined = joined;
        with_most = with;
        found = latest;
      }
    }
    if (most_joined.empty()) break;
    fixed = with_most;
    kept = found;
    std::erase_if(left, [&](std::size_t d) {
      return std::ranges::find(most_joined, d) != most_joined.end() ||
             kept.rates_n_per_mm(static_cast<Index>(d)) <= 0;
    });
  }
  return kept;
}

std::vector<ChosenSpring> springs_of(const ProgrammedSprings& best) {
  std::vector<ChosenSpring> springs;
  for (Index d = 0; d < best.rates_n_per_mm.size(); ++d) {
    if (best.rates_n_per_mm(d) > 0) {
      springs.push_back({static_cast<int>(d), best.rates_n_per_mm(d), best.free_mm(d)});
    }
  }
  return springs;
}

}  // namespace

Springs SpringChoice::filling(const Mechanism& mechanism) const {
  Springs filling;
  filling.stiffness_n_per_mm = options.most_rate_n_per_mm;
  filling.pull_only = options.pull_only;
  for (const Diagonal& d : mechanism.diagonals) filling.single.push_back({{d.from, d.to}, 0, {}});
  for (const ChosenSpring& spring : springs) {
    SingleSpring& single = filling.single[static_cast<std::size_t>(spring.diagonal)];
    single.stiffness_n_per_mm = spring.rate_n_per_mm;
    single.free_mm = spring.free_mm;
  }
  return filling;
}

StudyResult<SpringChoice> choose_springs(const Sheet& sheet, const SpringChoiceOptions& options) {
  const FoldingWay* const way = sheet.way();
  if (!way) return NoResult::path_lost;
  if (const auto fault = fault_of(sheet, *way, options)) return *fault;
  const double from_deg = driven_from_deg(sheet, *way, options.from_deg, options.to_deg);
  SpringProgram program(*way, from_deg, options.to_deg);
  const SpringRules rules = rules_of(*way, program, options);
  SpringSearch search = search_springs(
      program, rules, {.wanted_n_mm_per_mm = {}, .most_programs = options.most_programs});
  SpringChoice choice{};
  choice.options = options;
  choice.from_deg = from_deg;
  choice.relaxed_n_mm_per_mm = search.relaxed_n_mm_per_mm;
  choice.weights = search.best.weights;
  const double least = no_friction(program, rules);
  double wanted = options.equal_lengths_share.value_or(1) * search.best.static_n_mm_per_mm;
  if (options.fewest_margin && search.best.static_n_mm_per_mm > least) {
    wanted = options.friction_n_mm_per_mm * (1 + *options.fewest_margin);
    if (auto few = fewest(program, rules, wanted, options.most_programs)) {
      few->search.nodes += search.nodes;
      search = std::move(few->search);
      choice.proven_fewest = few->is_proven;
    }
  }
  if (options.equal_lengths_share && search.best.static_n_mm_per_mm > least) {
    wanted = std::min(wanted, search.best.static_n_mm_per_mm);
    search.best = with_few_lengths(program, rules, search.best, wanted);
  }
  choice.bound_n_mm_per_mm = search.bound_n_mm_per_mm;
  choice.static_n_mm_per_mm = search.best.static_n_mm_per_mm;
  choice.weakest_deg = search.best.weakest_deg;
  if (search.best.static_n_mm_per_mm > least) {
    choice.springs = springs_of(search.best);
    if (options.friction_n_mm_per_mm > 0) {
      choice.static_margin = choice.static_n_mm_per_mm / options.friction_n_mm_per_mm - 1;
    }
  } else {
    choice.driven_from_deg = largest_driven_deg(*way, from_deg, options);
  }
  choice.programs = program.programs();
  choice.pivots = program.pivots();
  choice.nodes = search.nodes;
  std::ranges::copy_if(program.places(), std::back_inserter(choice.rows), &DrivenPlace::is_row);
  return choice;
}

}  // namespace misalign::solver
