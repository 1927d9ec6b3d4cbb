// The verdict on a sheet that folds by its base's own fold angles, by the closed forms of its
// holes: nothing is followed. solver/pattern/README.md has the theorem.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/pattern/hole_motion.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class BaseJudge {
 public:
  /// The model is overconstrained, its base has a parallel family, and it must outlive this object.
  explicit BaseJudge(const Model& model);

  /// Of the sheet with these vertices: undecided where they are off the family.
  Verdict judge(const FlatVertices& vertices_mm);
  /// Of the sheet that was judged last.
  const Between& between() const { return judge_.between(); }
  /// Where the first of its diagonals turns back, deg, past faults too.
  std::optional<double> reverses_deg() const;

 private:
  // The diagonal that goes back the most between these pilot angles; -1: none does that counts.
  int goes_back_between(const HalfAngle<double>& from, const HalfAngle<double>& to) const;

  const Model& model_;
  std::vector<BaseHole> holes_;
  std::vector<HoleMotion> motions_;
  std::vector<double> lengths_, slopes_;  // panel widths; per radian of pilot
  Judge judge_;
};

}  // namespace misalign::solver
