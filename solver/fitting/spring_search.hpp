// Finds the best springs where each diagonal has one or none: branch and bound over linear
// programs.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/fitting/spring_program.hpp"

namespace misalign::solver {

/// Limits of all springs of a sheet.
struct SpringRules {
  /// Per diagonal, with a least rate of 0.
  std::vector<SpringRange> springs;
  std::vector<double> rates_n_per_mm;           ///< rates to choose from, ascending; empty: any
  std::vector<std::pair<int, int>> never_both;  ///< diagonals that do not both carry springs
  std::optional<int> most_springs;
};

struct SpringSearchOptions {
  /// The search ends when no springs can be better by more than this share.
  double gap = 1e-7;
  /// The friction at which the search may end; none: it seeks the best.
  std::optional<double> wanted_n_mm_per_mm;
  int most_programs = 20000;
};

struct SpringSearch {
  ProgrammedSprings best;
  /// No springs of the rules overcome more; with a wanted friction it may be far above the best.
  double bound_n_mm_per_mm;
  double relaxed_n_mm_per_mm;  ///< optimum of the relaxation, a linear program
  int nodes = 0;
};

SpringSearch search_springs(SpringProgram& program, const SpringRules& rules,
                            const SpringSearchOptions& options);

}  // namespace misalign::solver
