// The variables of an optimisation as one vector: coordinates of vertices, then springs.
#pragma once

#include "solver/optimise/optimise_options.hpp"

namespace misalign::solver {

/// Coordinates are x and y of each vertex that may be shifted, in turn, or the amounts of the
/// options' moves; then the springs' stiffness and preload, where these are variable. All but those
/// of a family lie between plus and minus the amplitude, to which the springs' ranges are scaled.
class Coordinates {
 public:
  /// `options` must outlive this object.
  explicit Coordinates(const OptimiseOptions& options);

  Eigen::Index count() const { return shifts_ + springs(); }
  /// Returns whether shifts are bounded only together, as within a family.
  bool are_free() const { return options_.moves.size() > 0; }
  /// The range of a coordinate of springs; null for one of shifts.
  const OptimiseOptions::Range* range(Eigen::Index k) const;
  /// Unit of a spring's coordinate: its change per mm.
  double per_mm(const OptimiseOptions::Range& range) const {
    return (range.most - range.least) / (2 * options_.amplitude_mm);
  }

  /// Coordinates of a design; free ones are 0.
  Eigen::VectorXd of(const DesignPoint& point) const;
  /// Returns the changed design, on the grid, within the amplitude and the springs' ranges:
  /// programs exceed bounds by rounding, and grids by up to half a step. A family's member is
  /// scaled down as a whole, and stays one.
  DesignPoint after(const DesignPoint& point, const Eigen::VectorXd& change_mm) const;
  /// The amplitude, on the grid.
  double largest_mm(Eigen::Index k) const;

  /// Gradient by the coordinates, from the derivatives by the vertices (x and y of each in turn),
  /// by the springs' stiffness (N/mm) and by their preload (N).
  Eigen::VectorXd row(const Eigen::RowVectorXd& by_vertices, double by_stiffness = 0,
                      double by_preload = 0) const;

 private:
  Eigen::Index springs() const {
    return (options_.stiffness_n_per_mm ? 1 : 0) + (options_.preload_n ? 1 : 0);
  }
  const OptimiseOptions& options_;
  const Eigen::Index shifts_;
};

/// point_of takes the springs from the options, set_springs puts them there.
DesignPoint point_of(const Eigen::Matrix2Xd& shifts_mm, const OptimiseOptions& options);
void set_springs(OptimiseOptions& options, const DesignPoint& point);

/// Rounds to a grid, mm; 0: no grid.
double on_grid(double mm, double grid_mm);

}  // namespace misalign::solver
