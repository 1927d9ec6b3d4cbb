// Stiffness of a sheet at rest: deployed, by the preload of its springs, or at a stop on the way.
#pragma once

#include <optional>

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// Second derivative of the energy of springs and panels, by linear bending. At a stop at rho > 0,
/// where every spring is relaxed, L' being the slopes of the diagonals there and C their
/// compliance: L'^T (1/k + C)^-1 L'. Flat: see preload_at_flat().
struct RestStiffness {
  double n_mm_per_rad;       ///< moment about the pilot crease per rad
  Eigen::VectorXd forces_n;  ///< each spring's force per rad at a stop: (1/k + C)^-1 L'
  double give_mm_per_n = 0;  ///< flat: that of PreloadAtFlat
};

/// Returns none where the path is lost or ends there, where springs rest at several angles, or at a
/// stop with a preload.
std::optional<RestStiffness> rest_stiffness(const Sheet& sheet, const ReleaseOptions& deploying,
                                            const PanelMaterial& material);

}  // namespace misalign::solver
