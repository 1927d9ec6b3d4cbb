// The options of a study of shapes.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solver/shape/target_surface.hpp"

namespace misalign::solver {

enum class ShapeKind {
  free,  ///< the shape alone
  rest,  ///< all diagonals monotone: springs relaxed at the shape stop the sheet there
};

struct ShapeOptions {
  std::shared_ptr<const TargetSurface> target;
  double at_deg = 90;     ///< pilot angle where it has the shape
  double from_deg = 110;  ///< stowed pilot angle
  ShapeKind kind = ShapeKind::rest;
  bool is_rim_fixed = false;
  std::optional<double> amplitude_mm;  ///< largest shift in x and in y; none: any
  double least_sine = 0.3;             ///< least sine of a corner of a panel or hole, flat
  double least_edge = 0.35;            ///< least length of an edge over the base's
  /// Least and largest fold angle of every crease at the shape.
  double least_fold_deg = 8, most_fold_deg = 172;
  double beyond_deg = 2;                 ///< the fold limit lies this far beyond the stowed angle
  double least_slope_mm_per_deg = 1e-3;  ///< the one of OptimiseOptions
  std::function<void()> watch = [] {};
};

}  // namespace misalign::solver
