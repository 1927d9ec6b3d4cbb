// What all sheets of one campaign share, made ready once: the base sheet, its mechanism, the order
// of elimination, the full path, and the angles at which the fast tests look.
#pragma once

#include "solver/linear/sparse_lu.hpp"
#include "solver/verdict/history.hpp"

namespace misalign::solver {

/// An angle of the fast tests: the base folding there, and its Jacobian's factors. One step of
/// theirs takes a misaligned sheet from the base folding to within a few per cent of its own.
struct TestAngle {
  int sample;
  HalfAngle<double> pilot;
  FoldState<double> base;
  SparseLu<double> factors;
  std::vector<double> lengths_per_closure;  ///< diagonals x equations: how errors of closure show
  int determinant_sign;
  bool with_slopes;  ///< whether the diagonals' rates of change are looked at as well
};

class SheetFamily {
 public:
  /// `shifted` are the vertices that differ from sheet to sheet; D of at least `threshold_sample`
  /// is wanted, which a bump between samples ends if it is a fault.
  SheetFamily(const PerforatedSheet& base, const std::vector<int>& shifted,
              const PathPlanOptions& path, int threshold_sample, bool bump_is_fault = false);
  SheetFamily(const SheetFamily&) = delete;
  SheetFamily& operator=(const SheetFamily&) = delete;

  const PerforatedSheet& base() const { return base_; }
  const Mechanism& mechanism() const { return mechanism_; }
  const Elimination& elimination() const { return elimination_; }
  const std::vector<int>& shifted() const { return shifted_; }
  /// Every sample to the end.
  const PathPlan& path() const { return path_; }
  double sample_deg() const { return sample_deg_; }
  int threshold_sample() const { return threshold_sample_; }
  bool bump_is_fault() const { return bump_is_fault_; }

  /// The far one, then the near one; none where the threshold is close to flat.
  const std::vector<TestAngle>& tests() const { return tests_; }
  /// Samples from the near test to the far one, and on to the threshold if that is farther.
  const PathPlan& approach() const { return approach_; }
  /// The test from whose states sheets depart on it: the far one, if the threshold is farther.
  int departs_from() const { return departs_from_; }
  /// Largest coordinate on the flat sheet from A1, panel widths.
  double extent() const { return extent_; }
  /// Bound of the change of any diagonal (panel widths) when every joint turns by 1 rad.
  double length_per_rad() const { return length_per_rad_; }

  /// The flat sheet with these shifts (mm; x and y of each shifted vertex in turn).
  void displace(const double* shifts_mm, FlatVertices& vertices_mm) const;

 private:
  void choose_tests();

  const PerforatedSheet base_;
  const Mechanism mechanism_;
  const Elimination elimination_;
  const std::vector<int> shifted_;
  const PathPlan path_;
  const double sample_deg_;
  const int threshold_sample_;
  const bool bump_is_fault_;
  std::vector<TestAngle> tests_;
  PathPlan approach_;
  int departs_from_ = 0;
  double extent_, length_per_rad_;
};

}  // namespace misalign::solver
