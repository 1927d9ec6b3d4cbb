// The study of a sheet whose panels bend: what its springs still do, and what friction they
// overcome.
//
// Rigid panels flatter: on the way from its springs to its creases most of the energy of a thin
// sheet goes into its panels. Everything here has its rigid counterpart in `deploy`, which is an
// upper bound.
#pragma once

#include <functional>
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
  double to_deg = kMarginTo_deg;     ///< margins are asked from the start down to this angle
  int angles = 16;                   ///< at which the panels are bent
  std::optional<BendMethod> method;  ///< none: as kLinearError says
};

/// Linear is right where Newton's method, at the start, changes the energy by no more than this
/// share: of all angles it bends the panels most there. 3 % rms against CalculiX is wanted.
inline constexpr double kLinearError = 0.02;

/// At one of the angles.
struct BentAngle {
  double pilot_deg;
  double rigid_n_mm;  ///< energy of the springs if panels were rigid
  BentState bent;
  bool
      is_sure;  ///< Newton's method has followed the equilibrium to it; true where it was not asked
  double largest_saddle_mm = 0;
  double largest_stress_mpa = 0;  ///< farther than kCornerWidths from the corners of a panel
};

/// How springs bend it at the start: the method that it takes, and what Newton's changes there.
struct Bending {
  BendMethod method;
  double newton_over_linear;  ///< energies; 1 where Newton's method was not asked, or lost it
};

/// A sheet at the angles, for any springs: its panels of one thickness and material.
class BentWay {
 public:
  /// `sheet` must have a way that reaches from_deg, and outlive this object.
  BentWay(const Sheet& sheet, const PanelMaterial& material, double thickness_mm, double to_deg,
          double from_deg, int angles);

  /// Whether the panels' stiffness is positive at all of its angles, as it is but for rounding.
  bool is_known() const { return is_known_; }
  const ElasticSheet& panels() const { return panels_; }
  const Eigen::VectorXd& pilot_deg() const { return pilot_deg_; }
  const std::vector<Compliance>& compliances() const { return compliances_; }

  Bending bending(const DiagonalSprings& springs) const;
  /// At every angle, linear or by Newton's method.
  std::vector<BentAngle> bend(const DiagonalSprings& springs, BendMethod method) const;
  EnergyCurve curve(const DiagonalSprings& springs, const std::vector<BentAngle>& angles) const;

 private:
  void bend_far(const DiagonalSprings& springs, std::vector<BentAngle>& angles) const;

  ElasticSheet panels_;
  double least_deg_, from_deg_;
  Eigen::VectorXd pilot_deg_;
  std::vector<Eigen::Matrix3Xd> folded_mm_;
  std::vector<Compliance> compliances_;
  bool is_known_ = true;
};

/// What else than springs and creases' friction acts at an angle of the rigid way: the energy of
/// elastic creases and weight, its change and that of ball joints' friction by the creases' sum.
struct OtherMoments {
  double n_mm, moment_n, balls_n;
};
using OtherMomentsAt = std::function<OtherMoments(double pilot_deg)>;
OtherMomentsAt other_moments(const EnergyModel& sheet);

/// Of one angle between the start and `to_deg`: N mm of moment for each mm of crease.
struct StaticMargin {
  double pilot_deg;
  double available_n;  ///< what drives it to flat
  /// available / resisting - 1; none without friction.
  std::optional<double> margin;
};

struct BentFriction {
  /// The largest friction of the creases with which a sheet let go at the start gets to flat: the
  /// energy margin is this over its own friction, less 1. None: it does not get there.
  std::optional<double> critical_n_mm_per_mm;
  double critical_deg = 0;
  /// The largest friction with which it moves on at every angle, however slowly, and where that is
  /// decided; not positive where it does not by itself.
  double static_n_mm_per_mm = 0, static_deg = 0;
  /// With its own friction: the least static margin, and the first angle from which it does not
  /// move on; none without friction, none where it moves on down to `to_deg`.
  std::optional<double> static_margin, static_stall_deg;
  std::vector<StaticMargin> rows;  ///< from the start down, at some forty angles
};

BentFriction find_bent_friction(const EnergyCurve& curve, double to_deg,
                                double friction_n_mm_per_mm, const OtherMomentsAt& others);

struct BentPanels {
  BentPanelsOptions options;
  double from_deg, thickness_mm;
  BendMethod method;
  double newton_over_linear;      ///< energies at the start; 1 where Newton's method was not asked
  std::vector<BentAngle> angles;  ///< ascending
  EnergyCurve curve;
  BentFriction friction;
  const BentAngle& most_bent() const;  ///< the largest stress
  int unsure() const;                  ///< angles where Newton's method did not converge
};
/// Faults: of the angles as `deploy`, springs that only pull, an angle `to_deg` that does not lie
/// below the start. Reasons: path_lost; panels_not_stable at one of the angles.
StudyResult<BentPanels> bend_panels(const Sheet& sheet, const ReleaseOptions& deploying,
                                    const BentPanelsOptions& options = {});

}  // namespace misalign::solver
