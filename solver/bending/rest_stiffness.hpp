// Stiffness of a sheet at rest: deployed, by the preload or pre-stretch of its filling, or at a
// stop on the way.
#pragma once

#include <optional>

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// Second derivative of the energy of filling and panels, by linear bending. At a stop at rho > 0,
/// where the filling is relaxed, K being its stiffness there, L' the slopes of the diagonals and C
/// their compliance: L'^T (1 + K C)^-1 K L'. Flat: see preload_at_flat().
struct RestStiffness {
  double n_mm_per_rad;       ///< moment about the pilot crease per rad
  Eigen::VectorXd forces_n;  ///< force per rad at a stop: (1 + K C)^-1 K L'
  double give_mm_per_n = 0;  ///< flat: that of PreloadAtFlat
};

/// Returns none where the path is lost or ends there, where springs rest at several angles, or at a
/// stop with a preload or pre-stretch.
std::optional<RestStiffness> rest_stiffness(const Sheet& sheet, const ReleaseOptions& deploying,
                                            const PanelMaterial& material);

}  // namespace misalign::solver
