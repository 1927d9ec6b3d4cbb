// What a force left in the springs at flat does: how firmly it holds the sheet's one motion there,
// how much of it is best, and which other motions it sets free.
#pragma once

#include <optional>

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// Springs that are relaxed flat give a moment that goes with the angle's cube: near flat friction
/// always wins. A force F of each at flat, pulling on diagonals that lengthen as the sheet folds
/// and pushing on those that shorten, gives one that goes with the angle. With rho the pilot's
/// angle, diagonals longer by L2 rho^2 and panels that give by C = C2 rho^2,
///   d2E/drho2 (flat) = 2 F s . L2 - F^2 s . C2 s,
/// s the signs of L2, and of a spring with a share of F that share: too much of it bends the panels
/// instead, and none is left at twice the best. F is that of the spring with the most.
struct PreloadAtFlat {
  double lead_mm;        ///< s . L2, per rad^2
  double give_mm_per_n;  ///< s . C2 s, per rad^2
  double stiffness_n_mm(double preload_n) const {
    return preload_n * (2 * lead_mm - preload_n * give_mm_per_n);
  }
  double best_n() const { return lead_mm / give_mm_per_n; }
  double none_left_n() const { return 2 * best_n(); }
};

/// So close to flat L2 and C2 are known to (angle / 3)^2.
inline constexpr double kNearFlat_deg = 1;

/// Panels that only bend; from a state next to flat. `shares`: of F in each spring.
/// None where the panels' stiffness is not positive.
std::optional<PreloadAtFlat> preload_at_flat(const Sheet& sheet, const PanelMaterial& material,
                                             double thickness_mm, const Eigen::VectorXd& shares);

/// Small motions of the flat sheet out of its plane in which no panel bends, its one motion among
/// them, and how many of them the springs' forces push on: each lowers the energy. A free sheet
/// leaves flat by these; a stop at flat in every crease, a latch or a frame holds them.
struct FlatModes {
  int rigid, unstable;
};
FlatModes find_flat_modes(const ElasticSheet& sheet, const DiagonalSprings& springs);

/// The preload with which the least static friction over the way is largest, and that friction, by
/// linear bending; 0 where none is better than none.
struct BestPreload {
  double preload_n, static_n_mm_per_mm;
};
BestPreload best_preload(const BentWay& way, double n_per_mm, double to_deg,
                         const PreloadAtFlat& at_flat, const Eigen::VectorXd& shares);

/// Forces are those of the spring with the most; the others keep their shares of it.
struct PreloadStudy {
  double preload_n;
  PreloadAtFlat at_flat;
  FlatModes modes;
  BestPreload best;
  /// With which its one motion would swing about flat, held there against all others; against a
  /// stop, half of each period. 0 where the preload does not hold it.
  double frequency_hz;
};
/// Of the springs with which the panels were bent (`bend_panels` of the same sheet and options).
/// Reasons: panels_not_stable next to flat.
StudyResult<PreloadStudy> study_preload(const Sheet& sheet, const ReleaseOptions& deploying,
                                        const BentPanels& bent);

}  // namespace misalign::solver
