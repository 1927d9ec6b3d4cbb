// The study of springs for one sheet: rates and free lengths, within limits, that overcome the most
// friction of the creases at every angle between the angle of use and flat.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/fitting/spring_program.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

struct SpringChoiceOptions {
  /// Angle of use; none: D, or the end of the path of a sheet whose D is 0.
  std::optional<double> from_deg;
  double to_deg = 1;  ///< springs overcome friction down to this angle
  double most_rate_n_per_mm = 50;
  std::vector<double> rates_n_per_mm;  ///< rates to choose from, ascending; empty: any
  double free_within = 0.05;           ///< largest change of a free length, share of the flat one
  bool pull_only = false;              ///< true: every spring pulls at every angle
  bool one_a_hole = false;
  std::vector<std::pair<int, int>> never_both;  ///< diagonals that do not both carry springs
  std::optional<int> most_springs;
  double friction_n_mm_per_mm = 0;  ///< dry friction of the creases
  /// Static margin over that friction that the fewest springs have.
  std::optional<double> fewest_margin;
  /// True: as few different free lengths as keep that margin, or without one this share of the best
  /// friction.
  std::optional<double> equal_lengths_share;
  int most_programs = 20000;  ///< effort of branch and bound
};

/// One spring of the choice.
struct ChosenSpring {
  int diagonal;
  double rate_n_per_mm, free_mm;
};

struct SpringChoice {
  SpringChoiceOptions options;
  double from_deg;  ///< angle of use
  std::vector<ChosenSpring>
      springs;                 ///< ascending diagonals; none where no springs drive the sheet
  double static_n_mm_per_mm;   ///< friction overcome at every angle
  double weakest_deg;          ///< pilot angle of its least
  double bound_n_mm_per_mm;    ///< no choice overcomes more
  double relaxed_n_mm_per_mm;  ///< bound by the linear program alone
  /// Static friction over the friction of the creases, less 1; none without friction.
  std::optional<double> static_margin;
  std::optional<bool> proven_fewest;  ///< true if fewer springs do not have the margin
  /// The largest angle from which springs drive it, 0 if from none; only where they do not.
  std::optional<double> driven_from_deg;
  int programs, pivots, nodes;    ///< effort
  std::vector<DrivenPlace> rows;  ///< rows of the programs
  std::vector<ProgrammedSprings::Weight>
      weights;  ///< weights of the places that limit the relaxation

  bool drives() const { return !springs.empty(); }
  /// The filling of a sheet with these springs; its other diagonals have none.
  Springs filling(const Mechanism& mechanism) const;
};

/// Faults: from_deg beyond the way; fewest_margin without friction. Reasons: path_lost.
StudyResult<SpringChoice> choose_springs(const Sheet& sheet, const SpringChoiceOptions& options);

}  // namespace misalign::solver
