// Bumps of a path in close steps (BumpRule::exact): whether a diagonal goes back between two solved
// samples, by solving states between them.
#pragma once

#include <vector>

#include "solver/judging/between_solver.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// What was found between two samples.
struct BumpFound {
  bool is_known = false;  ///< false: a state between could not be solved
  int where = -1;         ///< the diagonal that goes back the most; -1: none does
  double from_deg = 0;    ///< the pilot's angle from which on it does
};

class SolvedBumps {
 public:
  /// Both must outlive this object.
  SolvedBumps(const Mechanism& mechanism, BetweenSolver& solver);
  ~SolvedBumps();

  void put_flat(const SheetGeometry<double>& geometry, PathPoint& point) const {
    solver_.put_flat(geometry, point);
  }
  /// The same sheet at two pilot angles; the judge knows which way its diagonals go.
  BumpFound look(const SheetGeometry<double>& geometry, double from_deg, const PathPoint& from,
                 double to_deg, const PathPoint& to, const Judge& judge);

 private:
  bool go(const SheetGeometry<double>& geometry, const SolvedPlace& from, const SolvedPlace& to,
          int halvings, const Judge& judge);
  void follow(const SolvedPlace& from, const SolvedPlace& to, const Judge& judge);

  const Mechanism& mechanism_;
  BetweenSolver& solver_;
  std::vector<RetreatFrom> retreats_;  // since the last sample; of diagonals
};

}  // namespace misalign::solver
