// Gradients of one sheet by the variables of an optimisation, with its springs' forces and energy.
#pragma once

#include <utility>

#include "solver/motion/energy_model.hpp"
#include "solver/optimise/coordinates.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

struct SheetChanges {
  /// The sheet, which has a way and is not overconstrained, and its options, which have its springs
  /// and angle of use, must outlive this object.
  SheetChanges(const Sheet& given, const OptimiseOptions& given_options)
      : sheet(given),
        options(given_options),
        variables(given_options),
        gradients(given),
        flat(at(0)) {}

  /// Gradients at an angle; where they are not found, those of the flat sheet, and is_known is
  /// false.
  PathGradients::AtAngle at(double pilot_deg, bool with_folds = false) {
    options.watch();
    auto there = gradients.at(pilot_deg, with_folds);
    if (there) return std::move(*there);
    is_known = false;
    return flat;
  }

  /// Its bent panels.
  const StudyResult<BentPanels>& bent() {
    if (!bent_) bent_ = bend_panels(sheet, options.deploying, options.bending);
    return *bent_;
  }

  const Sheet& sheet;
  const OptimiseOptions& options;
  const Coordinates variables;
  bool is_known = true;
  PathGradients gradients;
  const PathGradients::AtAngle flat;

 private:
  std::optional<StudyResult<BentPanels>> bent_;
};

/// Springs that pull and push: f = k (L - L_rest) + F s, with s the sign of a diagonal's change
/// next to flat and F the preload; 0 on diagonals without a spring.
class SpringChanges {
 public:
  /// Springs of the options, or others of one rate. `changes` must outlive this object.
  explicit SpringChanges(SheetChanges& changes)
      : SpringChanges(changes, changes.options.deploying.sheet.springs()) {}
  SpringChanges(SheetChanges& changes, const Springs& springs);

  const EnergyModel& rigid() const { return rigid_; }
  double n_per_mm() const { return springs_.stiffness_n_per_mm; }
  /// 1 for each diagonal that has a spring, else 0.
  const Eigen::VectorXd& has_spring() const { return has_spring_; }
  /// Forces with panels rigid, N.
  Eigen::VectorXd forces_n(const PathGradients::AtAngle& at_angle) const;
  /// Gradient of the weighted sum of the forces by the coordinates; `weights`: one per spring.
  Eigen::VectorXd forces_row(const PathGradients::AtAngle& at_angle,
                             const Eigen::VectorXd& weights) const;
  /// The gradient of the energy of springs with these forces, panels held: in equilibrium their
  /// displacement has no effect to first order (the envelope theorem).
  Eigen::VectorXd energy_row(const PathGradients::AtAngle& at_angle,
                             const Eigen::VectorXd& forces_n) const;

 private:
  SheetChanges& changes_;
  const Springs springs_;
  const EnergyModel rigid_;
  Eigen::VectorXd has_spring_, side_, preload_n_, rest_mm_;  // s, F s, L_rest
  Eigen::MatrixXd rest_by_mm_;
};

}  // namespace misalign::solver
