// States of a path in close steps between two that were solved. Between solved states diagonals are
// cubics along the path; a state in the middle says how far off those are.
#pragma once

#include <memory>

#include "solver/continuation/path.hpp"
#include "solver/linear/elimination.hpp"
#include "solver/verdict/between.hpp"

namespace misalign::solver {

/// The error of a cubic's rate along its way of length one, to its error in the middle: 3.1 where
/// its fourth derivative is constant, and four times that for safety.
inline constexpr double kRatePerMiddle = 12.5;

/// Cubics this close to the solved state in their middle are as good as solved themselves: each
/// half has a sixteenth of that error.
inline constexpr double kSolved_widths = 1e-12;

/// How often a way between two samples is halved at most.
inline constexpr int kMostSolvedHalvings = 16;

struct SolvedPlace {
  double pilot_rad;
  const PathPoint& point;
};

/// A diagonal from place to place, see look_between.
CubicBetween cubic_between(const SolvedPlace& from, const SolvedPlace& to, int diagonal,
                           int direction);

/// How far the diagonals' cubics are off in their middle, most of all (panel widths), as the place
/// between has it, `share` of the way along the path.
double cubics_off(const SolvedPlace& from, const SolvedPlace& between, const SolvedPlace& to,
                  double share);

class BetweenSolver {
 public:
  /// Both must outlive this object, which makes its workspace when it is first asked.
  BetweenSolver(const Mechanism& mechanism, const Elimination& elimination);
  ~BetweenSolver();

  /// The flat sheet as the point before the first sample.
  void put_flat(const SheetGeometry<double>& geometry, PathPoint& point) const;
  /// Room for what is solved, so many halvings deep; or one deeper, for a single place.
  PathPoint& room(int halvings);
  /// The same sheet between two places. False: no state is found near them.
  bool solve(const SheetGeometry<double>& geometry, const SolvedPlace& from, const SolvedPlace& to,
             double pilot_rad, PathPoint& point);

 private:
  struct Workspace;
  Workspace& workspace();

  const Mechanism& mechanism_;
  const Elimination& elimination_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
