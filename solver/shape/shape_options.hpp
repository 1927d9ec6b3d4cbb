// The options of a study of shapes.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solver/optimise/optimise_options.hpp"
#include "solver/target/shape_fit.hpp"

namespace misalign::solver {

/// Ways in which springs of one rate on all diagonals hold the sheet at its shape.
enum class ShapeKind {
  free,            ///< not at all: the shape alone
  rest,            ///< relaxed at the shape, all diagonals monotone
  rest_by_energy,  ///< relaxed at the shape, their energy monotone on either side
  bistable         ///< relaxed at the shape and flat, with a barrier between
};

struct ShapeOptions {
  WantedShape target;
  double at_deg = 90;     ///< pilot angle where it has the shape
  double from_deg = 110;  ///< stowed pilot angle
  ShapeKind kind = ShapeKind::rest;
  /// Shifts with which the descent begins, and beside which vertices stay; none: the base's.
  std::optional<Eigen::Matrix2Xd> start_mm = {};
  double shift_weight = 0.01;  ///< weight of a vertex's distance from its start, in panel widths
  /// Diagonals that are to change against the direction that lengths suggest (ShapeKind::rest).
  std::vector<int> turned = {};
  bool is_rim_fixed = false;
  std::optional<double> amplitude_mm;  ///< largest shift in x and in y; none: any
  double least_sine = 0.3;             ///< least sine of a corner of a panel or hole, flat
  double least_edge = 0.35;            ///< least length of an edge over the base's
  /// Least and largest fold angle of every crease at the shape.
  double least_fold_deg = 8, most_fold_deg = 172;
  double beyond_deg = 1;                 ///< the fold limit lies this far beyond the stowed angle
  double least_slope_mm_per_deg = 1e-3;  ///< the one of OptimiseOptions
  /// Length of all springs together, |L - L_rest|, that a bistable sheet's barrier has at least.
  double barrier_mm = 0;
  /// Floors of goals, with their springs, hinges and panels; all vertices are `shifted`. Other
  /// members have no effect.
  OptimiseOptions keeping;
  std::function<void()> watch = [] {};
};

}  // namespace misalign::solver
