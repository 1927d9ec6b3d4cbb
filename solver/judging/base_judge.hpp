// Judges a sheet that folds by its base's fold angles, by closed forms of its holes, without
// following a path. solver/pattern/README.md has the theorem.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/pattern/hole_motion.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class BaseJudge {
 public:
  /// `model` must be overconstrained, have a parallel family, and outlive this object.
  explicit BaseJudge(const Model& model);

  /// Verdict on the sheet with these vertices: undecided if they are not of the family.
  Verdict judge(const FlatVertices& vertices_mm);
  /// Results of the sheet judged last.
  const Between& between() const { return judge_.between(); }
  /// Pilot angle of its first reversal, also beyond faults.
  std::optional<double> reverses_deg() const;

 private:
  // Diagonal with the largest retreat between these pilot angles; -1 if none counts.
  int goes_back_between(const HalfAngle<double>& from, const HalfAngle<double>& to) const;

  const Model& model_;
  std::vector<BaseHole> holes_;
  std::vector<HoleMotion> motions_;
  std::vector<double> lengths_, slopes_;  // panel widths; per radian of pilot
  Judge judge_;
  SheetGeometry<double> geometry_;
  std::vector<FoldState<double>> states_;  // at the samples, if friction needs them
};

}  // namespace misalign::solver
