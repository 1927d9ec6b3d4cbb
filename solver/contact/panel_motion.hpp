// Poses of every panel along a folding way, and their rates at the way's stations.
#pragma once

#include <cassert>
#include <optional>
#include <vector>

#include "solver/contact/panel_distance.hpp"
#include "solver/kinematics/folded_shape.hpp"
#include "solver/linear/sparse_lu.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

class PanelMotion {
 public:
  /// Maps a panel's flat coordinates (mm, A1 at the origin, z = 0) to folded ones, in which the
  /// first panel does not move.
  struct Pose {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d shift_mm;
  };
  /// A pose and its rates per unit of x.
  struct MovingPose : Pose {
    Eigen::Matrix3d rotation_rate;
    Eigen::Vector3d shift_rate_mm;
  };

  /// All arguments must outlive this object.
  PanelMotion(const Model& model, const FoldingWay& way, const Panels& panels);

  const FoldingWay& way() const { return way_; }
  int panels() const { return static_cast<int>(corners_mm_.size()); }
  double panel_width_mm() const { return model_.mechanism().panel_width_mm; }
  /// The four corners of a panel on the flat sheet.
  const PolygonCorners& corners_mm(int panel) const {
    return corners_mm_[static_cast<std::size_t>(panel)];
  }

  /// Pose at x: by the polynomials between the stations where these are accurate (kSmooth_mm),
  /// beyond by states that are solved once more.
  Pose pose(double x, int panel) const;
  /// Fold angle of a crease, likewise.
  double crease_rad(double x, int crease) const;
  /// Poses of all panels in a state.
  void place(const FoldState<double>& state, std::vector<Pose>& poses) const;
  /// Largest x to which rates at the stations tell those between: no corner's second difference
  /// exceeds kResolved of the rates there. Beyond, the path turns too sharply for these stations.
  double resolved_until() const { return resolved_until_; }

  /// Stations are nodes, from 0 on, the k-th at (k + 1/2) step().
  double step() const { return step_; }
  int nodes() const { return static_cast<int>(way_.stations().size()); }
  const MovingPose& at_node(int node, int panel) const {
    assert(node >= 0 && node < nodes() && panel >= 0 && panel < panels());
    return nodes_[static_cast<std::size_t>(node * panels() + panel)];
  }
  /// Rate of a crease's fold angle at a node, rad per unit of x.
  double crease_rate(int node, int crease) const;

 private:
  void place_at_stations();
  double smooth_part(const Eigen::MatrixXd& poses) const;
  double resolved_part() const;
  void solve(double x) const;

  const Model& model_;
  const FoldingWay& way_;
  const Panels& panels_;
  const double step_;
  std::vector<PolygonCorners> corners_mm_;
  std::vector<MovingPose> nodes_;
  double smooth_until_ = 0, resolved_until_ = 0;
  std::vector<SmoothTable> poses_;  // twelve functions of a panel each
  // The state that was solved last, and its x.
  mutable double solved_at_ = -1;
  mutable FoldState<double> state_;
  mutable std::vector<Pose> solved_;
  mutable SparseLu<double> lu_;
  mutable std::vector<double> residual_, work_, turn_;
  // The last poses of the panels and angles of the creases that the polynomials gave, and their x.
  struct CachedPose {
    double x;
    Pose pose;
  };
  mutable std::vector<CachedPose> cached_;
  mutable double creases_at_ = -1;
  mutable Eigen::VectorXd creases_rad_;
  mutable Eigen::VectorXd values_, slopes_;
};

/// Bound of the eighth differences of corners' coordinates, mm. The polynomials' error is a
/// thousandth of them between stations, and a fifth behind the last one.
inline constexpr double kSmooth_mm = 1e-7;

inline constexpr double kResolved = 0.1;

/// Stations that suffice for the panels of most sheets, and the largest number tried.
inline constexpr int kFewestMotionStations = 120, kMostMotionStations = 960;

/// Motion along a way with enough stations: kFewestMotionStations, doubled up to
/// kMostMotionStations, where it may still not be resolved to the end. None where the path is lost.
/// `sheet` must outlive it.
std::optional<PanelMotion> resolved_motion(const Sheet& sheet);

/// A point of panel b, flat coordinates, seen from panel a; and its velocity.
inline Eigen::Vector3d seen_from(const PanelMotion::Pose& a, const PanelMotion::Pose& b,
                                 const Eigen::Vector3d& point) {
  return a.rotation.transpose() * (b.rotation * point + b.shift_mm - a.shift_mm);
}
inline Eigen::Vector3d rate_seen_from(const PanelMotion::MovingPose& a,
                                      const PanelMotion::MovingPose& b,
                                      const Eigen::Vector3d& point) {
  return a.rotation_rate.transpose() * (b.rotation * point + b.shift_mm - a.shift_mm) +
         a.rotation.transpose() * (b.rotation_rate * point + b.shift_rate_mm - a.shift_rate_mm);
}

}  // namespace misalign::solver
