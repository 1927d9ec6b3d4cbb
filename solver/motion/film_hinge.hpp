// Hinges of film: a strip along each crease, clamped to both panels and bent between them.
#pragma once

#include <cassert>
#include <cmath>
#include <numbers>

namespace misalign::solver {

struct FilmHinge {
  double thickness_mm, e_gpa;
  double length_mm;  ///< free, from panel to panel
  double loss = 0;   ///< loss factor of the film: tan delta

  /// N mm per mm of crease for each rad: of a strip bent by moments at its ends.
  double stiffness_n_mm_per_mm() const {
    assert(thickness_mm > 0 && e_gpa > 0 && length_mm > 0);
    return 1e3 * e_gpa * std::pow(thickness_mm, 3) / (12 * length_mm);
  }
  /// The dry friction, N mm per mm, that takes as much as the film on the way from this angle (deg)
  /// to flat: a quarter of a cycle, in which it loses pi loss c angle^2 (Lakes, Viscoelastic
  /// Materials, 2009, section 3.4).
  double friction_n_mm_per_mm(double from_deg) const {
    assert(loss >= 0 && from_deg >= 0);
    const double angle_rad = from_deg * std::numbers::pi / 180;
    return std::numbers::pi / 4 * loss * stiffness_n_mm_per_mm() * angle_rad;
  }
};

}  // namespace misalign::solver
