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
  /// Takes a panel's flat coordinates (mm, A1 at the origin, z = 0) to folded ones, in which the
  /// first panel stays where it is.
  struct Pose {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d shift_mm;
  };
  /// Also how that changes, per unit of x.
  struct MovingPose : Pose {
    Eigen::Matrix3d rotation_rate;
    Eigen::Vector3d shift_rate_mm;
  };

  /// What it is made from must outlive it.
  PanelMotion(const Model& model, const FoldingWay& way, const Panels& panels);

  const FoldingWay& way() const { return way_; }
  int panels() const { return static_cast<int>(corners_mm_.size()); }
  double panel_width_mm() const { return model_.mechanism().panel_width_mm; }
  /// Four corners of a panel on the flat sheet.
  const PolygonCorners& corners_mm(int panel) const {
    return corners_mm_[static_cast<std::size_t>(panel)];
  }

  /// At x: by the polynomials between the stations as far as these are good for it, from there on
  /// from states that are solved once more.
  Pose pose(double x, int panel) const;
  /// Fold angle of a crease, likewise.
  double crease_rad(double x, int crease) const;
  /// Poses of all panels in a state.
  void place(const FoldState<double>& state, std::vector<Pose>& poses) const;
  /// As far as rates at the stations tell those between: no corner's second difference is more than
  /// kResolved of the rates there. Else the path turns too sharply for so many stations.
  double resolved_until() const { return resolved_until_; }

  /// Stations are nodes, from 0 on, the k-th at (k + 1/2) step().
  double step() const { return step_; }
  int nodes() const { return static_cast<int>(way_.stations().size()); }
  const MovingPose& at_node(int node, int panel) const {
    assert(node >= 0 && node < nodes() && panel >= 0 && panel < panels());
    return nodes_[static_cast<std::size_t>(node * panels() + panel)];
  }
  /// How fast a crease turns at a node, rad per unit of x.
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
  std::vector<SmoothTable> poses_;  // one: twelve functions a panel
  // The state that was solved last, and where.
  mutable double solved_at_ = -1;
  mutable FoldState<double> state_;
  mutable std::vector<Pose> solved_;
  mutable SparseLu<double> lu_;
  mutable std::vector<double> residual_, work_, turn_;
  // The last pose of each panel and of all creases that the polynomials gave, and where.
  struct CachedPose {
    double x;
    Pose pose;
  };
  mutable std::vector<CachedPose> cached_;
  mutable double creases_at_ = -1;
  mutable Eigen::VectorXd creases_rad_;
  mutable Eigen::VectorXd values_, slopes_;
};

/// What eighth differences of corners' coordinates may be, mm. The polynomials are off by a
/// thousandth of them between stations, and a fifth behind the last one.
inline constexpr double kSmooth_mm = 1e-7;

inline constexpr double kResolved = 0.1;

/// How few stations are enough for the motion of most sheets' panels, and how many are tried.
inline constexpr int kFewestMotionStations = 120, kMostMotionStations = 960;

/// Along a way with as many stations as the motion needs: kFewestMotionStations, twice as many, and
/// so on up to kMostMotionStations, where it may still not be resolved to the end. Nothing where
/// the path is lost. `sheet` must outlive it.
std::optional<PanelMotion> resolved_motion(const Sheet& sheet);

/// A point of panel b, flat coordinates, seen from panel a; and how fast it moves.
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
