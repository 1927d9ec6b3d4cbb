// Holds the model that all sheets of a campaign or pattern share, made once: the base sheet with
// its holes, its mechanism, the order of elimination, the full path, and the angles of the
// rejection tests.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/kinematics/folded_shape.hpp"
#include "solver/linear/sparse_lu.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/verdict/criterion.hpp"

namespace misalign::solver {

/// A place on the path for the rejection tests: the base folding there, and its Jacobian's factors.
/// One step with these takes a misaligned sheet from the base folding to within a few per cent of
/// its own. A sheet is at the place if it has the same level, a weighted sum of its unknowns: that
/// increases also where a sheet's pilot turns back.
struct TestPlace {
  double pilot_deg;  ///< the base folding's
  FoldState<double> base;
  SparseLu<double> factors;
  std::vector<double> level;    ///< weights of all unknowns
  std::vector<double> tangent;  ///< the base folding's, per unknown; it changes the level by 1
  std::vector<double> lengths_per_closure;  ///< diagonals x equations: d length / d closure
  int orientation;  ///< sign of det [J; level] while the level increases along the path
};

/// Shifts of a block of sheets, mm: x and y of each of the model's shifted vertices in turn.
struct ShiftBlock {
  std::vector<double> shifts_mm;  ///< sheet by sheet
  int sheets = 0;

  const double* of(int sheet) const {
    return shifts_mm.data() + shifts_mm.size() / static_cast<std::size_t>(sheets) * sheet;
  }
};

class Model {
 public:
  /// `shifted` are the vertices that differ between sheets. A sheet is accepted if D is at least
  /// `threshold_sample` by this criterion (exact bumps only for springs in the mid-plane). Without
  /// a threshold (0) there are no rejection tests and no miscut margin. `ternary_mm`: every shift
  /// is 0 or +- this (mm; 0: any shift).
  Model(const PerforatedSheet& base, const std::vector<int>& shifted, const PathPlanOptions& path,
        int threshold_sample, const Criterion& criterion = {}, double ternary_mm = 0);
  /// Model of a single sheet.
  explicit Model(const PerforatedSheet& base, const PathPlanOptions& path = {},
                 const Criterion& criterion = {})
      : Model(base, {}, path, 0, criterion) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const PerforatedSheet& base() const { return base_; }
  const Mechanism& mechanism() const { return mechanism_; }
  /// Empty for an overconstrained model.
  const Elimination& elimination() const { return elimination_; }
  /// Returns whether there are as many equations as unknowns or more, since there are too few holes
  /// for one degree of freedom: only sheets of the parallel family fold, by BasePath.
  bool is_overconstrained() const { return mechanism_.equations >= mechanism_.unknowns; }
  const FoldedShape& shape() const { return shape_; }
  const std::vector<int>& shifted() const { return shifted_; }
  /// All samples to the end.
  const PathPlan& path() const { return path_; }
  double sample_deg() const { return sample_deg_; }
  int threshold_sample() const { return threshold_sample_; }
  const Criterion& criterion() const { return criterion_; }
  BumpRule bumps() const { return criterion_.bumps; }
  double ternary_mm() const { return ternary_mm_; }
  /// Samples at which the sections of MiscutMargin end; none without a threshold.
  const std::vector<int>& margin_samples() const { return margin_samples_; }

  /// Places from the far to the near one; none if the threshold is close to flat.
  const std::vector<TestPlace>& tests() const { return tests_; }
  static constexpr int kFar = 0, kMiddle = 4, kNear = 7;  ///< indices of tests(), the last included
  /// Largest coordinate on the flat sheet from A1, panel widths.
  double extent() const { return extent_; }
  /// Bound of the change of any diagonal (panel widths) when every joint turns by 1 rad.
  double length_per_rad() const { return length_per_rad_; }

  /// The place at which the base folding has this pilot angle.
  TestPlace test_at(double pilot_deg) const;

  /// The flat sheet with these shifts (mm; x and y of each shifted vertex in turn).
  void displace(const double* shifts_mm, FlatVertices& vertices_mm) const;

 private:
  void choose_tests();

  const PerforatedSheet base_;
  const Mechanism mechanism_;
  const Elimination elimination_;
  const FoldedShape shape_;
  const std::vector<int> shifted_;
  const PathPlan path_;
  const double sample_deg_;
  const int threshold_sample_;
  const Criterion criterion_;
  const double ternary_mm_;
  const std::vector<int> margin_samples_;
  std::vector<TestPlace> tests_;
  double extent_, length_per_rad_;
};

}  // namespace misalign::solver
