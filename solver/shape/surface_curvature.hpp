// The principal curvatures of a folded sheet: of a quadric in the middle between its two levels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct SurfaceCurvature {
  /// The larger magnitude first; positive of a dome seen from above.
  std::array<double, 2> per_mm;
  Eigen::Matrix<double, 3, 2> directions;  ///< unit tangents at the middle, in the vertices' frame
  double half_depth_mm;                    ///< height of level 1 above the quadric
  double rms_mm;  ///< root mean square of the vertices' distances from their levels
};

/// Fits a quadric, a height above the vertices' plane, by least squares of the distances of folded
/// vertices from its two offsets by the half depth, and takes the curvatures where x and y have
/// their mean. `sides`: per vertex, 1 above or -1 below, 0 leaves it out; where all are alike the
/// quadric is fitted to the vertices. None if these do not determine it, or
/// are farther from it than a twentieth of their size, as those of a sheet that is rolled up. A
/// circle's curvature is too large by at most 3 / 2 of the square of (distance from the middle /
/// radius).
std::optional<SurfaceCurvature> surface_curvature(const Eigen::Matrix3Xd& vertices_mm,
                                                  const Eigen::VectorXd& sides,
                                                  const Eigen::Vector3d& up);

/// The levels of a corrugation seen from +z: inner vertices with three mountains lie above, those
/// with three valleys below; 0 on the perimeter.
Eigen::VectorXd level_sides(const PerforatedSheet& base);

/// The curvatures of a sheet with its pilot at this angle. None if it does not reach it, or has
/// fewer than four inner rows or columns.
std::optional<SurfaceCurvature> surface_curvature(const Sheet& sheet, double pilot_deg);

}  // namespace misalign::solver
