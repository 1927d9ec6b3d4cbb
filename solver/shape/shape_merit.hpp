// The merit of a sheet that is shaped, the smaller the better: squares of the vertices' distances
// from the target, of shifts, of their unevenness and of the area's change, and a price for what
// violates its rows; and its quadratic program around a sheet.
#pragma once

#include <vector>

#include "solver/linear/quadratic_program.hpp"
#include "solver/shape/shape_rows.hpp"
#include "solver/target/shape_fit.hpp"

namespace misalign::solver {

class ShapeMerit {
 public:
  /// `base`, the flat sheet that is not shifted, must outlive this object. `free`: vertices that
  /// may be shifted. Shifts from `start_mm` on have `shift_weight`.
  ShapeMerit(const CreasePattern& base, std::vector<int> free, Eigen::Matrix2Xd start_mm,
             double shift_weight);

  double value(const ShapeMisfit& misfit, const Eigen::Matrix2Xd& shifts_mm,
               const std::vector<ShapeRow>& rows) const;
  /// The program without its box; `weights` are those of the target's rows. Variables: x and y of
  /// each free vertex in turn, mm; then the pose's change (ShapePose::after), turns as arcs of the
  /// sheet's size.
  QuadraticProgram program(const ShapeMisfit& misfit, const Eigen::MatrixXd& weights,
                           const PathGradients::Shape& folded, const Sheet& sheet,
                           const std::vector<ShapeRow>& rows) const;

 private:
  double misfit_weight() const;
  void add_regular(const Sheet& sheet, QuadraticProgram& program) const;
  Eigen::MatrixXd of_free(const Eigen::MatrixXd& by_vertices) const;

  const CreasePattern& base_;
  const double width_mm_, size_mm_;
  const std::vector<int> free_;
  const Eigen::Matrix2Xd start_mm_;
  const double shift_weight_per_mm_;
  const double area_mm2_;             // the base's
  const Eigen::MatrixXd unevenness_;  // squares of second differences, by the vertices
};

}  // namespace misalign::solver
