// Gradients of lengths, fold angles and shapes along a sheet's way, by the coordinates of its flat
// vertices.
//
// Each gradient is one transposed solve of the loop closure (the adjoint, as in FlatGradient), so
// that all vertices together cost little more than one. With x the unknowns but the pilot, v the
// vertices:
//   F(x, pilot, v) = 0,  dq/dv = q_v - (J^-T q_x) . F_v  of any quantity q, pilot held;
// and J is singular where the pilot turns: with its left null vector w,
//   d(limit)/dv = -(w . F_v) / (w . F_pilot).
// Slopes are differences of lengths at four angles next to one, and so are their gradients, with
// errors of the fourth power of kSlopeStep_rad.
#pragma once

#include <memory>
#include <optional>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

inline constexpr double kSlopeStep_rad = 5e-4;

class PathGradients {
 public:
  /// Gradients at one pilot angle, which is held: rows with x and y of each vertex in turn, per mm.
  struct AtAngle {
    double pilot_deg;
    Eigen::VectorXd length_mm;     ///< one per spring, on the diagonals
    Eigen::MatrixXd length_by_mm;  ///< diagonals x (2 vertices): mm per mm
    Eigen::VectorXd fold_deg;      ///< one per crease, valleys positive
    Eigen::MatrixXd fold_by_mm;    ///< creases x (2 vertices): deg per mm
  };

  /// The slopes of the diagonals at one pilot angle.
  struct Slopes {
    Eigen::VectorXd slope_mm_per_rad;  ///< per rad of the pilot's angle
    Eigen::MatrixXd slope_by_mm;       ///< diagonals x (2 vertices): mm per rad per mm
  };

  /// The folded sheet at one pilot angle, its first panel held.
  struct Shape {
    Eigen::Matrix3Xd at_mm;  ///< place of every vertex
    Eigen::MatrixXd by_mm;   ///< (3 vertices) x (2 vertices): mm per mm
  };

  struct AtLimit {
    double fold_limit_deg;
    Eigen::RowVectorXd by_mm;  ///< deg per mm
  };

  /// `sheet`, which has a way and is not overconstrained, must outlive this object.
  explicit PathGradients(const Sheet& sheet);
  ~PathGradients();

  /// Gradients at an angle of the way between flat and its end, where states are corrected. Only
  /// lengths have gradients at flat. None where the correction fails.
  std::optional<AtAngle> at(double pilot_deg, bool with_folds = true);
  /// None also where the way ends within twice kSlopeStep_rad.
  std::optional<Slopes> slopes(double pilot_deg);
  /// Shape with the gradients of all vertices, for distances between panels.
  std::optional<Shape> vertices(double pilot_deg);
  /// None where the way does not end at a fold limit.
  std::optional<AtLimit> fold_limit();

 private:
  struct Workspace;
  bool solve_at(double pilot_deg);

  const Sheet& sheet_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace misalign::solver
