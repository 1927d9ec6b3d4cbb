// Everything there is to know about one path: for the few patterns somebody looks at.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/continuation/path.hpp"
#include "solver/kinematics/folded_shape.hpp"
#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

class DenseLook;
struct Elimination;

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
  Between between;
  std::vector<double> flat_mm;  ///< per diagonal
  std::vector<Stop> stops;
  Eigen::MatrixXd length_mm;         ///< stops x diagonals
  Eigen::MatrixXd slope_mm_per_deg;  ///< the same: their rates of change
  Eigen::MatrixXd fold_angle_deg;    ///< stops x creases
  std::vector<double> open_by;       ///< largest closure entry: radians, panel widths
  std::vector<double> singular_value_min;
  std::vector<double> isometry_error_mm;         ///< see FoldedShape
  std::vector<FoldState<double>> margin_states;  ///< at RecordingOptions::margin_samples
  std::optional<double> miscut_margin_mm;        ///< once the path has reached all of those

  /// Whether the solver failed where the path may go on.
  bool lost() const { return path.end == PathEnd::start_lost || path.end == PathEnd::stalled; }
};

/// The state at a stop, what follows from it, and how well it was solved and can be.
struct SeenStop {
  const Stop& stop;
  const FoldState<double>& state;
  const std::vector<double>& lengths;  ///< per diagonal, panel widths
  const std::vector<double>& slopes;   ///< panel widths per radian of pilot
  double pilot_rate;                   ///< the pilot's entry of the unit tangent
  double open_by;                      ///< largest closure entry: radians, panel widths
  double singular_value_min;           ///< of the square Jacobian
  double isometry_error;               ///< panel widths
};

/// Called at each stop of a path, in order.
using StopVisitor = std::function<void(const Stop&, const FoldState<double>&)>;

struct RecordingOptions {
  bool bump_is_fault = false;         ///< see Judge
  StopVisitor visit{};                ///< if there is one
  std::vector<int> margin_samples{};  ///< margin_samples() of miscut_margin.hpp; none: no margin
};

/// A history in the making.
class Recording {
 public:
  /// `mechanism` must outlive this object.
  explicit Recording(const Mechanism& mechanism, RecordingOptions options = {});

  /// A new sheet.
  void begin(const FlatVertices& vertices_mm);
  const FlatVertices& vertices_mm() const { return vertices_mm_; }
  /// The next stop of its path; past faults too.
  void see(const SeenStop& seen);
  /// The same from the state alone, by dense factors.
  void see_densely(const Stop& stop, const FoldState<double>& state, const FoldedShape& shape);
  /// The whole, once the path has ended.
  FoldingHistory conclude(const PathResult& path);

 private:
  const Mechanism& mechanism_;
  StopVisitor visit_;
  std::vector<int> margin_samples_;
  Judge judge_;
  FlatVertices vertices_mm_;
  std::shared_ptr<DenseLook> dense_;                                 // made when first needed
  std::vector<double> lengths_mm_, slopes_mm_per_deg_, angles_deg_;  // stop by stop
  FoldingHistory history_;
};

/// Whether a verdict hangs on a fold limit next to 180 degrees, where the fixed order's factors are
/// poor and false turns were seen: dense matrices have the last word, if they have one.
bool is_for_dense_to_confirm(const Verdict& verdict, const PathResult& path);

/// The history, or where it is lost or to be confirmed the one by dense matrices.
FoldingHistory confirmed(FoldingHistory history, const Mechanism& mechanism,
                         const FoldedShape& shape, const PathPlan& plan,
                         const FlatVertices& vertices_mm, const RecordingOptions& options);

/// Follows the path of the sheet with these vertices to the plan's end or the fold limit, past
/// faults. A path that is lost is followed again by dense matrices: then `visit` sees it from the
/// first stop once more.
FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm,
                              const RecordingOptions& options = {});

/// The same with an order of elimination that was planned before: it is the mechanism's, so that
/// whoever follows many sheets of it plans once.
FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const Elimination& elimination, const PathPlan& plan,
                              const FlatVertices& vertices_mm,
                              const RecordingOptions& options = {});

/// The same by dense matrices with pivoting: for the rare sheet that the fixed order of elimination
/// does not suit.
FoldingHistory record_densely(const Mechanism& mechanism, const FoldedShape& shape,
                              const PathPlan& plan, const FlatVertices& vertices_mm,
                              const RecordingOptions& options = {});

}  // namespace misalign::solver
