// One sheet of a model, and all results for it.
//
// A `Model` is shared by all sheets, a `SheetSolver` is the workspace of one thread, a `Sheet`
// holds the data of one sheet. Each result is computed once, when it is first requested.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "solver/model/panels.hpp"
#include "solver/records/metrics.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

class PathSource;
struct PathOutline;

/// Follows the paths of a model's sheets, one after another.
class SheetSolver {
 public:
  /// `model` must outlive this object.
  explicit SheetSolver(const Model& model);
  ~SheetSolver();
  SheetSolver(const SheetSolver&) = delete;
  SheetSolver& operator=(const SheetSolver&) = delete;

  const Model& model() const { return model_; }
  const Panels& panels() const { return panels_; }

  const PathSource& paths() const { return *paths_; }

 private:
  friend class Sheet;

  const Model& model_;
  const Panels panels_;
  const std::unique_ptr<PathSource> paths_;
};

/// A sheet belongs to the thread of its solver.
class Sheet {
 public:
  /// One column of shifts per vertex, off the model's base. `solver` must outlive this object;
  /// sentences call the sheet `name`.
  Sheet(SheetSolver& solver, Eigen::Matrix2Xd shifts_mm, std::string name = "the sheet");

  const Model& model() const { return solver_.model(); }
  const PerforatedSheet& base() const { return model().base(); }
  const Mechanism& mechanism() const { return model().mechanism(); }
  const Panels& panels() const { return solver_.panels(); }
  const std::string& name() const { return name_; }
  const Eigen::Matrix2Xd& shifts_mm() const { return shifts_mm_; }
  const FlatVertices& vertices_mm() const { return vertices_mm_; }
  Eigen::Vector2d point_mm(int vertex) const { return vertices_mm_.col(vertex); }

  /// The path in long steps, as a campaign measures its draws.
  const PathRecord& record() const;
  const Verdict& verdict() const { return record().verdict; }
  /// D, and the angle of a sample.
  double deploys_from_deg() const { return sample_deg(verdict().deploys_from_sample); }
  double sample_deg(int sample) const { return sample * model().sample_deg(); }

  /// The path in close steps, every station. Its bumps are those of the record.
  const FoldingHistory& history() const;
  /// Vertices at each row of the history: 3 x vertices. Each rigid shape is moved to where it fits
  /// the flat sheet at z = 0 best (least squares over the vertices; Kabsch 1976), so that
  /// neighbours differ little.
  const std::vector<Eigen::Matrix3Xd>& shapes_mm() const;
  /// Rate of the span at each row, from the exact rates of all joints. The span is between the two
  /// vertices that are farthest apart when flat.
  const std::vector<double>& span_slope_mm_per_deg() const;
  /// The states at its rows; rates are by radian of pilot.
  const std::vector<WayStation>& states() const;

  /// Metrics over every sample up to D, by the history; null where the sheet deploys from nothing.
  const Metrics* metrics() const;
  /// The same by another history of this sheet.
  std::optional<Metrics> measure(const FoldingHistory& history) const;

  /// The path as functions of one coordinate, solved at `stations` stations; null: it is lost.
  const FoldingWay* way(int stations = kWayStations) const;

  /// The sheet where its pilot has one angle.
  struct Pose {
    FoldState<double> state;
    bool is_closed;                ///< true if the correction converged
    Eigen::Matrix3Xd vertices_mm;  ///< the first panel stays where it is
    Eigen::VectorXd fold_deg;      ///< per crease, valleys positive
    Eigen::VectorXd length_mm;     ///< per diagonal
  };
  /// The way's state, closed once more with the pilot held: its error between stations, micrometres
  /// near a limit, would stress panels. The way must exist and reach the angle.
  const Pose& at(double pilot_deg) const;

  /// The history's row at this pilot angle (see kSameAngle_deg); none where it has no station.
  std::optional<Eigen::Index> row_at(double pilot_deg) const;
  /// Number of the history's rows up to D, without the flat sheet.
  Eigen::Index rows_up_to_d() const;
  /// Number of rows to show: those up to D, or of a sheet that deploys from nothing those that are
  /// folded well, except for rounding of angles near 180 degrees.
  Eigen::Index rows_shown() const;
  /// Those of them that become files, frames or lines of a table: multiples of `step_deg`, and the
  /// last.
  std::vector<Eigen::Index> rows_to_show(double step_deg) const;

 private:
  PathExtremes extremes_of(const FoldingHistory& history) const;

  SheetSolver& solver_;
  const Eigen::Matrix2Xd shifts_mm_;
  const FlatVertices vertices_mm_;
  const std::string name_;
  mutable std::optional<PathRecord> record_;
  mutable std::optional<FoldingHistory> history_;
  mutable std::vector<WayStation> states_;
  mutable std::vector<Eigen::Matrix3Xd> shapes_mm_;
  mutable std::vector<double> span_slope_mm_per_deg_;
  mutable std::optional<std::optional<Metrics>> metrics_;
  mutable std::shared_ptr<const PathOutline> outline_;
  mutable std::map<int, std::optional<FoldingWay>> ways_;  // keys: stations
  mutable std::map<double, Pose> poses_;                   // keys: pilot_deg
};

/// Number of first rows with every crease on its side and none folded past 180 degrees by more than
/// the band: those that can be shown of a sheet that deploys from nothing.
Eigen::Index rows_folded_well(const Mechanism& mechanism, const FoldingHistory& history,
                              double band_deg = kOverFoldBand_deg);

}  // namespace misalign::solver
