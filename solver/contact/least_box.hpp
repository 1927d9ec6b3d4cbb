// Finds the least box around a shape: the room of a stowed sheet in a payload bay.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Length, width and height of the box of least volume around these points, descending; for points
/// in a plane that of least area. Descents over rotations begin at many starts and end within 0.001
/// degrees.
Eigen::Vector3d least_box_mm(const Eigen::Matrix3Xd& points_mm);

}  // namespace misalign::solver
