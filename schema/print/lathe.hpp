// Makes solids of revolution.
#pragma once

#include <Eigen/Core>

#include "schema/print/solid.hpp"

namespace misalign::schema {

/// The solid that a profile sweeps round an axis (a unit vector) through `origin`. The profile's
/// points are (distance from the axis, height along it); it begins and ends on the axis and has the
/// solid on its left. Chords stay within kChordOff_mm of their circles.
Solid lathe(const PlanePoints& profile, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);

}  // namespace misalign::schema
