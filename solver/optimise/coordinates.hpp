// What an optimisation may change, as one vector: where vertices lie, and then springs.
#pragma once

#include "solver/optimise/optimise_options.hpp"

namespace misalign::solver {

/// Coordinates: x and y of each vertex that may be shifted, in turn, or what the moves of the
/// options are taken by; then the springs' rate and their preload, where these may be chosen. All
/// but those of a family lie between plus and minus the amplitude: the springs' from the least to
/// the most.
class Coordinates {
 public:
  /// `options` must outlive this object.
  explicit Coordinates(const OptimiseOptions& options);

  Eigen::Index count() const { return shifts_ + springs(); }
  /// Whether shifts have bounds together only, as within a family.
  bool are_free() const { return options_.moves.size() > 0; }
  /// The range in which it is chosen, of the springs'; null: it is one of shifts.
  const OptimiseOptions::Range* range(Eigen::Index k) const;
  /// What a mm of such a coordinate is.
  double per_mm(const OptimiseOptions::Range& range) const {
    return (range.most - range.least) / (2 * options_.amplitude_mm);
  }

  /// Of each; of those that are free nothing.
  Eigen::VectorXd of(const DesignPoint& point) const;
  /// No farther than the amplitude and the springs' ranges, on the grid: programs pass their bounds
  /// by rounding, and grids by up to half a step. A family's member is made smaller as a whole, and
  /// is one still.
  DesignPoint after(const DesignPoint& point, const Eigen::VectorXd& change_mm) const;
  /// The amplitude, on the grid.
  double largest_mm(Eigen::Index k) const;

  /// A quantity's change by each, of its change by the vertices (x and y of each in turn), by the
  /// springs' rate (N/mm) and by their preload (N).
  Eigen::VectorXd row(const Eigen::RowVectorXd& by_vertices, double by_stiffness = 0,
                      double by_preload = 0) const;

 private:
  Eigen::Index springs() const {
    return (options_.stiffness_n_per_mm ? 1 : 0) + (options_.preload_n ? 1 : 0);
  }
  const OptimiseOptions& options_;
  const Eigen::Index shifts_;
};

/// The springs of the options, and these as the point has them.
DesignPoint point_of(const Eigen::Matrix2Xd& shifts_mm, const OptimiseOptions& options);
void set_springs(OptimiseOptions& options, const DesignPoint& point);

/// What is rounded to a grid, mm; 0: there is none.
double on_grid(double mm, double grid_mm);

}  // namespace misalign::solver
