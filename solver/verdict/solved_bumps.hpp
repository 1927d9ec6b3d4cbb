// Whether a diagonal goes back between two samples that were solved (BumpRule::exact), by solving
// states between them: for paths in close steps. Between solved states diagonals are cubics along
// the path; a state in the middle says how far off those are.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/linear/elimination.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// What was found between two samples.
struct BumpFound {
  bool is_known = false;  ///< false: a state between could not be solved
  int where = -1;         ///< the diagonal that goes back the most; -1: none does
};

class SolvedBumps {
 public:
  /// Both must outlive this object, which makes its workspace when it is first asked.
  SolvedBumps(const Mechanism& mechanism, const Elimination& elimination);
  ~SolvedBumps();

  /// The flat sheet as the point before the first sample.
  void put_flat(const SheetGeometry<double>& geometry, PathPoint& point) const;
  /// The same sheet at two pilot angles; the judge knows which way its diagonals go.
  BumpFound look(const SheetGeometry<double>& geometry, double from_deg, const PathPoint& from,
                 double to_deg, const PathPoint& to, const Judge& judge);

 private:
  struct Workspace;
  struct End {
    double pilot_rad;
    const PathPoint& point;
  };

  bool go(const SheetGeometry<double>& geometry, const End& from, const End& to, int halvings,
          const Judge& judge);
  bool solve(const SheetGeometry<double>& geometry, const End& from, const End& to,
             double pilot_rad, PathPoint& point);
  CubicBetween cubic(const End& from, const End& to, int diagonal, int direction) const;
  void follow(const End& from, const End& to, const Judge& judge);

  const Mechanism& mechanism_;
  const Elimination& elimination_;
  std::unique_ptr<Workspace> workspace_;
  std::vector<WayBack> ways_;  // since the last sample; of diagonals
};

}  // namespace misalign::solver
