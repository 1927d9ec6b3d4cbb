// The study of preload: how stiffly it holds the sheet's one motion at flat, the best preload, and
// the other motions that it makes unstable.
#pragma once

#include <optional>

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// Springs that are relaxed flat give a moment proportional to the angle's cube: near flat friction
/// always wins. A force F of each at flat, pulling on diagonals that lengthen as the sheet folds
/// and pushing on those that shorten, gives a moment proportional to the angle. With rho the
/// pilot's angle, diagonals longer by L2 rho^2 and panels that give by C = C2 rho^2,
///   d2E/drho2 (flat) = 2 F s . L2 - F^2 s . C2 s,
/// s the signs of L2, and of a diagonal with a share of F that share with its sign: too much of it
/// bends the panels instead, and none is left at twice the best. F is that of the spring with the
/// most.
struct PreloadAtFlat {
  double lead_mm;        ///< s . L2, per rad^2
  double give_mm_per_n;  ///< s . C2 s, per rad^2
  double stiffness_n_mm(double preload_n) const {
    return preload_n * (2 * lead_mm - preload_n * give_mm_per_n);
  }
  double best_n() const { return lead_mm / give_mm_per_n; }
  double none_left_n() const { return 2 * best_n(); }
};

/// Angle near flat at which L2 and C2 are found, to (angle / 3)^2.
inline constexpr double kNearFlat_deg = 1;

/// Finds it for panels that only bend, from a state next to flat. `shares` of F are the signed
/// forces on the diagonals, s in the formula. None where the panels' stiffness is not positive.
std::optional<PreloadAtFlat> preload_at_flat(const Sheet& sheet, const PanelMaterial& material,
                                             double thickness_mm, const Eigen::VectorXd& shares);

/// Small motions of the flat sheet out of its plane in which no panel bends, including its one
/// motion, and the number of them that the springs' forces drive: each lowers the energy. A free
/// sheet leaves flat by these; a stop at flat in every crease, a latch or a frame holds them.
struct FlatModes {
  int rigid, unstable;
};
FlatModes find_flat_modes(const ElasticSheet& sheet, const Filling& filling);

/// The preload of springs of these rates, one a diagonal (0: no spring), with these shares of it,
/// with which the least static friction over the way is largest, and that friction, by linear
/// bending; 0 where no preload is better.
struct BestPreload {
  double preload_n, static_n_mm_per_mm;
};
BestPreload best_preload(const BentWay& way, const Eigen::VectorXd& rates_n_per_mm, double to_deg,
                         const PreloadAtFlat& at_flat, const Eigen::VectorXd& shares);

/// Forces are those of the spring with the largest preload; the others keep their shares of it.
struct PreloadStudy {
  double preload_n;
  PreloadAtFlat at_flat;
  FlatModes modes;
  BestPreload best;
  /// Frequency of its one motion about flat, all others being held; against a stop each swing takes
  /// half a period. 0 where the preload does not hold it.
  double frequency_hz;
};
/// Studies the springs with which the panels were bent (`bend_panels` of the same sheet and
/// options). Reasons: panels_not_stable next to flat.
StudyResult<PreloadStudy> study_preload(const Sheet& sheet, const ReleaseOptions& deploying,
                                        const BentPanels& bent);

}  // namespace misalign::solver
