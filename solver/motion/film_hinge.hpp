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

  /// Stiffness of a strip bent by moments at its ends, N mm per mm of crease for each rad.
  double stiffness_n_mm_per_mm() const {
    assert(thickness_mm > 0 && e_gpa > 0 && length_mm > 0);
    return 1e3 * e_gpa * std::pow(thickness_mm, 3) / (12 * length_mm);
  }
  /// The dry friction, N mm per mm, that dissipates as much as the film from this angle (deg) to
  /// flat: a quarter of a cycle, which dissipates pi loss c angle^2 (Lakes, Viscoelastic Materials,
  /// 2009, section 3.4).
  double friction_n_mm_per_mm(double from_deg) const {
    assert(loss >= 0 && from_deg >= 0);
    const double angle_rad = from_deg * std::numbers::pi / 180;
    return std::numbers::pi / 4 * loss * stiffness_n_mm_per_mm() * angle_rad;
  }
};

}  // namespace misalign::solver
