// The changes of one sheet with the variables of an optimisation, and of its springs' forces and of
// what they store.
#pragma once

#include <utility>

#include "solver/motion/energy_model.hpp"
#include "solver/optimise/coordinates.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

struct SheetChanges {
  /// `of`, which has a way and is not overconstrained, and `asked`, which says from where it is let
  /// go and has its springs, must outlive this object.
  SheetChanges(const Sheet& of, const OptimiseOptions& asked)
      : sheet(of), options(asked), variables(asked), gradients(of), flat(at(0)) {}

  /// Where they are not found it is not known, and the flat sheet's stand in their place.
  PathGradients::AtAngle at(double pilot_deg, bool with_folds = false) {
    options.watch();
    auto there = gradients.at(pilot_deg, with_folds);
    if (there) return std::move(*there);
    is_known = false;
    return flat;
  }

  const Sheet& sheet;
  const OptimiseOptions& options;
  const Coordinates variables;
  bool is_known = true;
  PathGradients gradients;
  const PathGradients::AtAngle flat;
};

/// Springs that pull and push: f = k (L - L_rest) + F s, with s which way a diagonal goes next to
/// flat and F the preload.
class SpringChanges {
 public:
  /// `changes` must outlive this object.
  explicit SpringChanges(SheetChanges& changes);

  const EnergyModel& rigid() const { return rigid_; }
  double n_per_mm() const { return springs().stiffness_n_per_mm; }
  /// Forces with panels rigid, N.
  Eigen::VectorXd forces_n(const PathGradients::AtAngle& here) const;
  /// A row of their changes: by the coordinates, `weights` one per spring.
  Eigen::VectorXd forces_row(const PathGradients::AtAngle& here,
                             const Eigen::VectorXd& weights) const;
  /// The gradient of the energy of springs with these forces, panels where they are: in equilibrium
  /// that changes nothing to first order (the envelope theorem).
  Eigen::VectorXd energy_row(const PathGradients::AtAngle& here,
                             const Eigen::VectorXd& forces_n) const;

 private:
  const Springs& springs() const { return changes_.options.deploying.sheet.springs; }

  SheetChanges& changes_;
  const EnergyModel rigid_;
  Eigen::VectorXd side_, preload_n_, rest_mm_;  // s, F s, L_rest
  Eigen::MatrixXd rest_by_mm_;
};

}  // namespace misalign::solver
