// Advises how a sheet whose panels bend would overcome more friction.
#pragma once

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// The stiffness (N/mm) from which on the critical friction is at least kUseful of that with
/// infinitely stiff springs, relaxed on the flat sheet; bending is linear where the stiffest
/// springs bend panels linearly. None where they do not drive it to flat, or Newton's method loses
/// the equilibrium under them.
inline constexpr double kUseful = 0.9;
std::optional<double> useful_stiffness_n_per_mm(const BentWay& way);

/// Improvements, by linear bending: about a dozen further thicknesses are computed.
struct BentAdvice {
  std::optional<double> useful_stiffness_n_per_mm;
  /// The least thickness (mm) with which the static margin is `wanted_margin`; none without
  /// friction, or where none of up to kMostThick_mm does. The weight does not change.
  double wanted_margin;
  std::optional<double> least_thickness_mm;
};
inline constexpr double kMostThick_mm = 50;

/// `study` is of this sheet and these options.
BentAdvice advise(const Sheet& sheet, const ReleaseOptions& deploying, const BentPanels& study,
                  double wanted_margin = kWantedMargin);

}  // namespace misalign::solver
