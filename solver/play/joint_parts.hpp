// Defines what ball joints are made of: see joint_play.hpp.
#pragma once

#include <algorithm>

namespace misalign::solver {

enum class JointKind { loop, ball, tab };

struct JointParts {
  JointKind kind = JointKind::loop;
  double bore_mm = 1.2;       ///< diameter
  double wire_mm = 1;         ///< diameter, at most the bore's
  double edge_mm = 2;         ///< distance of bores from the sides of their panels
  double trim_mm = 0;         ///< trim of their corners, from which bores are as far
  double clearance_mm = 0.4;  ///< diametral clearance of balls
  double strip_mm = 2;        ///< free length of tabs

  /// The same between plates whose corners are trimmed: nothing of them clamps a tab nearer to its
  /// vertex.
  JointParts between_plates(double trimmed_mm) const {
    JointParts parts = *this;
    parts.trim_mm = trimmed_mm;
    parts.strip_mm = std::max(strip_mm, 2 * trimmed_mm);
    return parts;
  }
};

}  // namespace misalign::solver
