// Proves an interval of a folding path: every pilot angle of the interval has exactly one folded
// state within a box round a polynomial, and J is regular there.
//
// Let F(x, s) = 0 be the loop closure, s in [-1, 1] the place in the interval, p(s) the path as a
// polynomial, C(s) near J^-1 and X(s) = p(s) + [-r, r]. If for every s
//     -C(s) F(p(s), s) + (I - C(s) J(X(s), s)) [-r, r]   lies within   (-r, r)
// then X(s) holds exactly one solution, and J is regular in X(s) (Krawczyk 1969; Rump 1983, theorem
// 4.1; Neumaier, Interval Methods for Systems of Equations, section 5.1). It depends on s
// continuously, hence these solutions are one curve.
#pragma once

#include <array>

#include "solver/certificate/dual.hpp"
#include "solver/certificate/krawczyk.hpp"
#include "solver/certificate/polynomial.hpp"
#include "solver/model/panels.hpp"

namespace misalign::solver {

/// Squares of the flat sheet's diagonals, and the products of each hole's two: panel widths
/// squared.
struct FlatDiagonals {
  std::vector<Ball> squares, products;
};

/// All diagonals all over a tube.
struct DiagonalsAlong {
  std::vector<PathModel> stretches;  ///< GradedClosure::squared_elongation
  std::vector<PathModel> slopes;     ///< derivatives of the squared lengths by s
};

class TubeProver {
 public:
  enum class End {
    proven,
    no_state,    ///< Newton's method finds no state from the middle that was given
    too_curved,  ///< no polynomial is within the box of the path: a shorter interval may have one
    not_unique   ///< C J is too far from I: it may be nearer on a shorter interval, or in a smaller
                 ///< box
  };

  /// Proves intervals of the sheet with these vertices. `mechanism` must outlive this object.
  TubeProver(const Mechanism& mechanism, const FlatVertices& vertices_mm);

  /// Proves an interval; `box` is the largest of r. `tube` is valid only if proven.
  End prove(const PathInterval& interval, double box, PathTube& tube);
  /// Factor by which the last interval, proven or not, should have been longer.
  double better_length() const;

  FlatDiagonals flat_diagonals() const;

  /// Finds all diagonals all over the tube, which must be the last proven one.
  DiagonalsAlong find_diagonals(const PathTube& tube) const;

  /// Corners of the panels all over a tube, from GradedClosure::place_panels.
  std::vector<std::array<GradedVector<JacobianModel>, 4>> place_panels(const PathTube& tube,
                                                                       const FoldedShape& shape,
                                                                       const Panels& panels) const;

 private:
  template <class T, class Use>
  void with_closure(const IntervalChart& chart, const SheetGeometry<T>& geometry, const T* x,
                    const T& s, Use&& use) const;
  template <class T>
  std::vector<T> residual_of(const IntervalChart& chart, const SheetGeometry<T>& geometry,
                             const std::vector<T>& x, const T& s) const;
  Eigen::MatrixXd inverse_at(const IntervalChart& chart, const std::vector<double>& x,
                             double s) const;
  bool solve_middle(IntervalChart& chart);
  void find_inverse(const PathTube& tube);
  std::vector<PathModel> find_path(const IntervalChart& chart) const;
  std::vector<JacobianModel> unknowns(const PathTube& tube, double box) const;
  void find_deviation(const PathTube& tube, double box);
  template <int Degree>
  void add_powers(const IntervalChart& chart, const SheetGeometry<Polynomial<Degree>>& sheet,
                  int steps, Eigen::MatrixXd& path) const;

  const Mechanism& mechanism_;
  const SheetGeometry<Ball> exact_sheet_;
  const SheetGeometry<PathModel> path_sheet_;
  const SheetGeometry<JacobianModel> jacobian_sheet_;
  const SheetGeometry<Dual<PathModel>> moving_sheet_;
  SheetGeometry<double> sheet_;
  SheetGeometry<Polynomial<kHalfDegree>> half_sheet_;
  SheetGeometry<Polynomial<kPathDegree>> whole_sheet_;
  // State of the last interval.
  Krawczyk krawczyk_;
  Eigen::MatrixXd rate_bounds_;  // columns: diagonals, upper bounds of |d elongation / dx|
  double error_ = 0, contraction_ = 0;
};

}  // namespace misalign::solver
