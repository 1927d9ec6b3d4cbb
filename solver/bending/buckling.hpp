// Buckling of the panels: by what factor the forces of springs and joints may grow before a panel
// buckles, estimated for each panel.
//
// The lowest mode of a panel is most often the saddle of a corner between two hole edges, pressed
// towards the opposite corner by a ball joint or a spring; creases stay straight in it. With the
// edges' lengths kept to second order a corner that rises by w lets its force P move by w^2 / d,
// d being the diagonal, so that a saddle of pure twist has P_cr = (1 - nu) D d / A. Free edges and
// neighbours that give way lower it: kCornerShare lay below CalculiX's *BUCKLE of twelve
// single panels, and of four whole sheets in one run of two. The bound by mean stress lay above
// CalculiX in some panels, which is not explained (results/buckling.md).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "solver/bending/bent_panels.hpp"

namespace misalign::solver {

/// P_cr A / (1 - nu) D d of a corner between two hole edges.
inline constexpr double kCornerShare = 0.35;
/// k of N_cr = k pi^2 D / b^2: a long plate with one free edge (Timoshenko & Gere, table 9-2), b
/// being the panel's longer diagonal, since no width is larger.
inline constexpr double kMeanStress = 0.43;

/// Forces on a panel in its plane, in the coordinates of the flat sheet. Edge i is from corner i to
/// the next.
struct PlaneForces {
  std::array<Eigen::Vector2d, 4> corner_n, edge_n;  ///< those on edges act at their middles
  std::array<double, 4> edge_n_mm{};  ///< moments about their middles, counter-clockwise

  PlaneForces() { corner_n.fill({0, 0}), edge_n.fill({0, 0}); }
};

/// A panel against buckling. Corners in mm, counter-clockwise; `is_crease[i]`: edge i is one.
struct BucklingPanel {
  std::array<Eigen::Vector2d, 4> corners_mm;
  std::array<bool, 4> is_crease;
  double rigidity_n_mm;  ///< D = E t^3 / 12 (1 - nu^2)
  double poisson;

  double area_mm2() const;
  /// Mean membrane force, N/mm: sum F (x) x / A, moments of edges as linear tractions on them.
  Eigen::Matrix2d mean_force_n_per_mm(const PlaneForces& forces) const;
};

enum class BucklingKind { none, corner, mean_stress };
struct BucklingFactor {
  double factor;  ///< infinite if nothing presses the panel
  BucklingKind kind = BucklingKind::none;
  int corner = -1;  ///< the pressed corner, of `corner`
};
/// The least of the bounds by its corners and by its mean stress.
BucklingFactor buckling_factor(const BucklingPanel& panel, const PlaneForces& forces);

/// The panels of a sheet that have this thickness.
std::vector<BucklingPanel> buckling_panels(const Sheet& sheet, const PanelMaterial& material,
                                           double thickness_mm);

/// Forces in the plane of each panel (second index) at each angle, where the sheet is held and its
/// filling pulls along the diagonals with these forces.
std::vector<std::vector<PlaneForces>> plane_forces(
    const Sheet& sheet, const EnergyModel& rigid, const std::vector<double>& pilot_deg,
    const std::vector<Eigen::VectorXd>& filling_forces_n);

struct BucklingStudy {
  struct Least : BucklingFactor {
    double pilot_deg = 0;
    std::array<int, 2> place{};  ///< row and column of the panel
  };
  std::vector<double> pilot_deg;                     ///< ascending
  std::vector<std::vector<BucklingFactor>> factors;  ///< a row for each angle, one a panel
  std::vector<Least> panels;                         ///< the least of each panel
  const Least& least() const;
};
/// Factors at the angles of a bent sheet down to its options' to_deg, by the forces of its
/// filling on bent panels: joints balance them at the pose of the rigid sheet. `bent` is of this
/// sheet and these options.
BucklingStudy find_buckling(const Sheet& sheet, const EnergyModel::Options& options,
                            const BentPanels& bent);

}  // namespace misalign::solver
