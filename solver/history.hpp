// Everything there is to know about one path: for the few patterns somebody looks at.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/isometry.hpp"
#include "solver/tracker.hpp"
#include "solver/verdict.hpp"

namespace misalign::solver {

/// A correct sheet with holes: what a pattern file or a campaign describes, before any shift.
struct PerforatedSheet {
  CreasePattern sheet;
  std::vector<int> holes;  ///< facet indices, ascending
  BaseFolding folding;
};

/// One row or entry per stop that was solved; verdicts look at those with sample > 0.
struct FoldingHistory {
  Verdict verdict;
  PathResult path;
  std::vector<double> flat_mm;  ///< per diagonal
  std::vector<Stop> stops;
  Eigen::MatrixXd length_mm;       ///< stops x diagonals
  Eigen::MatrixXd fold_angle_deg;  ///< stops x creases
  std::vector<double> open_by;     ///< largest closure entry: radians, panel widths
  std::vector<double> singular_value_min;
  std::vector<double> isometry_error_mm;
};

/// Records one path after another of sheets that share a mechanism.
class HistoryRecorder {
 public:
  /// All must outlive this object.
  HistoryRecorder(const PerforatedSheet& base, const Mechanism& mechanism,
                  const Elimination& elimination, const PathPlan& plan);

  /// Follows the path of the sheet with these vertices to the plan's end or the fold limit, past
  /// faults.
  FoldingHistory record(const FlatVertices& vertices_mm);

 private:
  class Recording;

  const Mechanism& mechanism_;
  const PathPlan& plan_;
  Tracker<double> tracker_;
  FoldedShape shape_;
};

/// The same for a single sheet.
FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
