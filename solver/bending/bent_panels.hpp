// The study of a sheet whose panels bend: the energy left in its springs, and the friction that
// they overcome.
//
// Rigid panels promise too much: most of the springs' energy in a thin sheet goes into its panels.
// Everything here has its rigid counterpart in `deploy`, which is an upper bound.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/bending/bent_state.hpp"
#include "solver/bending/energy_curve.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::solver {

enum class BendMethod { linear, newton };

struct BentPanelsOptions {
  PanelMaterial material;
  double to_deg = kMarginTo_deg;     ///< margins are computed from the start down to this angle
  int angles = 16;                   ///< number of angles at which the panels are bent
  std::optional<BendMethod> method;  ///< none: chosen by kLinearError
};

/// Linear bending suffices where Newton's method changes the energy at the start, where panels bend
/// most, by no more than this share. The aim is 3 % rms against CalculiX.
inline constexpr double kLinearError = 0.02;

/// Bending at one of the angles.
struct BentAngle {
  double pilot_deg;
  double rigid_n_mm;  ///< energy of the filling with rigid panels
  BentState bent;
  bool is_sure;  ///< true if linear, or followed by Newton's method
};

/// The method chosen, from bending at the start, and the effect of Newton's method there.
struct Bending {
  BendMethod method;
  double newton_over_linear;  ///< ratio of energies; 1 where Newton's method did not run or failed
  std::unique_ptr<BentFollower> start{};  ///< null in the same case
};

/// A sheet at all angles, for any filling; its panels have one thickness and material.
class BentWay {
 public:
  /// `sheet` must have a way that reaches from_deg, and outlive this object.
  BentWay(const Sheet& sheet, const PanelMaterial& material, double thickness_mm, double to_deg,
          double from_deg, int angles);

  /// Returns whether the panels' stiffness is positive at all angles, as it is except for rounding.
  bool is_known() const { return is_known_; }
  const ElasticSheet& panels() const { return panels_; }
  const Eigen::VectorXd& pilot_deg() const { return pilot_deg_; }
  const std::vector<Compliance>& compliances() const { return compliances_; }

  Bending bending(const Filling& filling) const;
  /// Bends panels at every angle, linearly or by Newton's method; `start` is of the same filling.
  std::vector<BentAngle> bend(const Filling& filling, BendMethod method,
                              std::unique_ptr<BentFollower> start = {}) const;
  EnergyCurve curve(const Filling& filling, const std::vector<BentAngle>& angles) const;

 private:
  void bend_far(const Filling& filling, std::unique_ptr<BentFollower> follower,
                std::vector<BentAngle>& angles) const;

  ElasticSheet panels_;
  double least_deg_, from_deg_;
  Eigen::VectorXd pilot_deg_;
  std::vector<Eigen::Matrix3Xd> folded_mm_;
  std::vector<Compliance> compliances_;
  bool is_known_ = true;
};

/// Effects other than springs and creases' friction at an angle of the rigid way: the energy of
/// elastic creases and weight, and the derivatives of this and of ball joints' friction by the
/// creases' turning.
struct OtherMoments {
  double n_mm, moment_n, balls_n;
};
using OtherMomentsAt = std::function<OtherMoments(double pilot_deg)>;
OtherMomentsAt other_moments(const EnergyModel& sheet);

/// Static margin at one angle between the start and `to_deg`: N mm of moment for each mm of crease.
struct StaticMargin {
  double pilot_deg;
  double available_n;  ///< driving moment, positive to flat
  /// available / resisting - 1; none without friction.
  std::optional<double> margin;
};

struct BentFriction {
  /// The largest friction of the creases with which a sheet released at the start reaches flat: the
  /// energy margin is this over the sheet's friction, less 1. None: it does not reach flat.
  std::optional<double> critical_n_mm_per_mm;
  double critical_deg = 0;
  /// The largest friction with which it moves at every angle, however slowly, and the angle that
  /// decides; not positive where the sheet does not move by itself.
  double static_n_mm_per_mm = 0, static_deg = 0;
  /// The least static margin with the sheet's friction, and the first angle at which it stalls;
  /// none without friction, no stall where it moves down to `to_deg`.
  std::optional<double> static_margin, static_stall_deg;
  std::vector<StaticMargin> rows;  ///< descending from the start, about forty angles
};

BentFriction find_bent_friction(const EnergyCurve& curve, double to_deg,
                                double friction_n_mm_per_mm, const OtherMomentsAt& others);

struct BentPanels {
  BentPanelsOptions options;
  double from_deg, thickness_mm;
  BendMethod method;
  double newton_over_linear;      ///< energies at the start; 1 where Newton's method did not run
  std::vector<BentAngle> angles;  ///< ascending
  EnergyCurve curve;
  BentFriction friction;
  std::shared_ptr<const BentWay> way;  ///< never null

  /// The largest stress in each panel (rows) at each angle, farther than kCornerWidths from its
  /// corners; takes some ms.
  Eigen::MatrixXd stress_mpa() const;
  /// The angle of the largest stress.
  struct MostBent {
    double pilot_deg, largest_saddle_mm, largest_stress_mpa;
  };
  MostBent most_bent() const;
  int unsure() const;  ///< angles where Newton's method did not converge
};
/// Faults: those of the angles in `deploy`, a filling without energy, an angle `to_deg` that does
/// not lie below the start. Reasons: path_lost; panels_not_stable at one of the angles.
StudyResult<BentPanels> bend_panels(const Sheet& sheet, const ReleaseOptions& deploying,
                                    const BentPanelsOptions& options = {});

}  // namespace misalign::solver
