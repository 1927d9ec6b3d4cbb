// Finds the least box around a shape: what a stowed sheet takes of a payload bay.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Length, width and height of the box of least volume around these points, descending; of points
/// in a plane that of least area. By descents over rotations from many starts, each to within
/// 0.001 degrees.
Eigen::Vector3d least_box_mm(const Eigen::Matrix3Xd& points_mm);

}  // namespace misalign::solver
