// Finds equilibria of a sheet, and limits of its dry friction.
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/energy_model.hpp"

namespace misalign::solver {

/// A stationary point of the potential along the way.
struct Equilibrium {
  double x, pilot_deg;
  double energy_n_mm;
  /// d2E / d(pilot)2, N mm/rad2: positive in a well. It is 0 at flat where springs are relaxed
  /// flat: the energy grows with the fourth power there.
  double stiffness_n_mm;
  bool is_well;
};

/// Returns all from -end to end of the way, ascending; flat exactly, where the way is symmetric.
/// Returns none where the energy is constant, as for springs of a sheet without shifts.
std::vector<Equilibrium> find_equilibria(const EnergyModel& sheet);

/// Limits of dry friction for a sheet released at rest at a pilot angle, to deploy.
struct FrictionLimits {
  /// The largest friction of the creases (N mm per mm) with which it reaches flat: the least over
  /// the way of (E(from) - E) / (sum of l_i times the turn of crease i), its limit at the start
  /// included. It holds for any mass, without damping. None where the sheet does not start towards
  /// flat, or does not reach it.
  std::optional<double> critical_n_mm_per_mm;
  double critical_deg = 0;  ///< pilot angle of that minimum
  /// Static stall: the first pilot angle on the way to flat at which the moment does not exceed the
  /// sheet's friction, so that slow motion stops. 0 without friction.
  double static_stall_deg = 0;
  /// The stiffness (N/mm) with which the sheet's friction would be the critical one; none without
  /// friction, or where springs do not drive it to flat.
  std::optional<double> stiffness_needed_n_per_mm;
};

/// Finds the friction limits of a sheet released at from_deg, above 0.
FrictionLimits find_friction_limits(const EnergyModel& sheet, double from_deg);

}  // namespace misalign::solver
