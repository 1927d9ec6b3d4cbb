// Energies and resistances of a folding sheet, as functions of the coordinate x of its way.
// The motion with T = mass / 2 (dx/dt)^2 is
//   mass x'' + mass' x'^2 / 2 + potential' + friction sign(x') + damping x' = 0.
#pragma once

#include <optional>

#include "solver/motion/plates.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::solver {

/// Resistance of the joints.
struct JointResistance {
  double friction_n_mm_per_mm = 0;   ///< dry, per length of crease
  double ball_friction_n_mm = 0;     ///< dry, of each ball joint
  double damping_n_mm_s_per_mm = 0;  ///< per length of crease, for each rad/s
  double stiffness_n_mm_per_mm = 0;  ///< elastic, per length of crease, for each rad
  double rest_deg = 0;               ///< the pilot angle at which creases are relaxed

  bool slows_down() const {
    return friction_n_mm_per_mm > 0 || ball_friction_n_mm > 0 || damping_n_mm_s_per_mm > 0;
  }
};

/// Support of the sheet: a held panel (index among the panels), and gravity.
struct HeldPanel {
  int panel;
  Eigen::Vector3d gravity_mm_per_s2 = Eigen::Vector3d::Zero();  ///< frame of that panel, z up
};

/// Energies and resistances at one x. Derivatives are by x.
struct EnergyAt {
  double mass, mass_slope;  ///< t mm^2
  double filling_n_mm;      ///< energy of the filling
  double potential, slope;  ///< total energy, N mm
  double friction;          ///< N mm: always opposes the motion
  double damping;           ///< N mm s
};

/// Lengths of all creases.
Eigen::VectorXd crease_lengths_mm(const FoldingWay& way);

class EnergyModel {
 public:
  struct Options {
    Fill fill = Springs{};
    JointResistance joints;
    Plates plates;
    std::optional<HeldPanel> held;  ///< none: free in space

    /// The filling must be springs.
    const Springs& springs() const { return std::get<Springs>(fill); }
    Springs& springs() { return std::get<Springs>(fill); }
  };

  /// The sheet's way must be there, and outlive this object. Rest angles must lie on it.
  EnergyModel(const Sheet& sheet, const Options& options)
      : EnergyModel(*sheet.way(), sheet.model().shape(), sheet.base(), options) {}
  /// `way` and `shape` must outlive this object. Rest angles must lie on the way.
  EnergyModel(const FoldingWay& way, const FoldedShape& shape, const PerforatedSheet& base,
              const Options& options);

  const FoldingWay& way() const { return way_; }
  const Options& options() const { return options_; }
  double mass_t() const { return mass_t_; }
  const Filling& filling() const { return filling_; }

  EnergyAt at(double x) const;
  /// An energy and its derivative: of the filling, and of all else.
  struct Potential {
    double energy, slope;
  };
  Potential filled(double x) const;
  Potential all_else(double x) const;
  /// Force on each diagonal, positive where the filling pulls.
  Eigen::VectorXd filling_forces_n(double x) const;
  /// Returns whether its forces are no larger than those of diagonals off by `within_mm`.
  bool is_filling_relaxed(double x, double within_mm) const;
  /// Moment with which each crease resists an increase of its fold angle, at this dx/dt.
  Eigen::VectorXd crease_moments_n_mm(double x, double x_rate) const;

  /// Turning against friction, per unit of x: the sum of l_i |d rho_i| over the creases (mm), and
  /// that of the ball joints' angles.
  struct Turning {
    double creases_mm, balls;
  };
  Turning turning(double x) const;

 private:
  const FoldingWay& way_;
  const Options options_;
  double mass_t_;
  const Filling filling_;
  Eigen::VectorXd crease_mm_, rest_rad_;
  SmoothTable masses_;  // generalised mass; centre of mass x, y, z
  mutable Eigen::VectorXd lengths_, length_rates_, angles_, angle_rates_, others_, speeds_, mass_,
      mass_rate_;
};

}  // namespace misalign::solver
