// The changes of one sheet with the variables of an optimisation.
#pragma once

#include <utility>

#include "solver/optimise/coordinates.hpp"
#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

struct SheetChanges {
  /// `of`, which has a way and no spare equations, and `asked`, which says from where it is let go
  /// and has its springs, must outlive this object.
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

}  // namespace misalign::solver
