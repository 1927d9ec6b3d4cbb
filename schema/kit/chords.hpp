// Divides arcs into chords.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace misalign::schema {

inline constexpr double kChordOff_mm = 0.005;  ///< largest distance of a chord from its arc

/// The directions of an arc's points seen from its middle, its ends among them.
inline std::vector<double> chord_angles_rad(double from_rad, double turn_rad, double radius_mm) {
  const double most_rad = 2 * std::acos(1 - kChordOff_mm / radius_mm);
  const int chords = std::max(1, static_cast<int>(std::ceil(std::abs(turn_rad) / most_rad)));
  std::vector<double> angles_rad;
  for (int k = 0; k <= chords; ++k) angles_rad.push_back(from_rad + turn_rad * k / chords);
  return angles_rad;
}

}  // namespace misalign::schema
