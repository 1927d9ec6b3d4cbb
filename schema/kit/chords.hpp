// Divides arcs into chords.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

inline constexpr double kChordOff_mm = 0.005;  ///< largest distance of a chord from its arc

/// The points of an arc round a centre, its ends among them; counter-clockwise where the turn is
/// positive.
inline PlanePoints arc_points(const Eigen::Vector2d& centre_mm, double radius_mm, double from_rad,
                              double turn_rad) {
  const double most_rad = 2 * std::acos(1 - kChordOff_mm / radius_mm);
  const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / most_rad)));
  PlanePoints points;
  for (int k = 0; k <= chords; ++k) {
    const double rad = from_rad + turn_rad * k / chords;
    points.emplace_back(centre_mm + radius_mm * Eigen::Vector2d(std::cos(rad), std::sin(rad)));
  }
  return points;
}

}  // namespace misalign::schema
