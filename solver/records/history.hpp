// Holds all results of one path, with its verdict.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "solver/judging/extreme_finder.hpp"
#include "solver/model/model.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// One row or entry per solved station; verdicts use those with sample > 0.
struct FoldingHistory {
  Verdict verdict;
  PathResult path;
  Between between;
  std::optional<PathExtremes> extremes;  ///< if requested, without bumps
  std::vector<double> flat_mm;           ///< per diagonal
  /// Last sample up to which the filling's energy falls to flat, sample by sample, whatever the
  /// diagonals do (Criterion::without_margins).
  int energy_deploys_from_sample = 0;
  std::vector<Station> stations;
  std::vector<double> turning_mm;    ///< per station: of all creases (turning_mm)
  Eigen::MatrixXd length_mm;         ///< stations x diagonals
  Eigen::MatrixXd slope_mm_per_deg;  ///< stations x diagonals: rates of change
  Eigen::MatrixXd fold_angle_deg;    ///< stations x creases
  std::vector<double> open_by;       ///< largest closure entry: radians, panel widths
  std::vector<double> singular_value_min;
  std::vector<double> isometry_error_mm;         ///< see FoldedShape
  std::vector<FoldState<double>> margin_states;  ///< states at the model's margin_samples
  std::optional<double> miscut_margin_mm;        ///< if the path has reached all of these
};

/// Called at each station of a path, in order, with its results.
using StationVisitor = std::function<void(const Station&, const PathPoint&)>;

}  // namespace misalign::solver
