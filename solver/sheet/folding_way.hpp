// The folding path of one sheet as a function of one coordinate, from flat to its end. Studies
// evaluate it at any angle, not only at samples.
//
// The coordinate x is the pilot's fold angle where the path ends at a given angle. Where it ends at
// a fold limit, pilot = limit * sin x: the pilot stands still at the limit, but everything that is
// smooth along the path is smooth in x there too. Fold angles are odd in x, lengths even (except
// those of springs off the mid-plane): the mirror image lies on the other side of flat.
#pragma once

#include <optional>

#include "solver/model/model.hpp"
#include "solver/sheet/smooth_table.hpp"

namespace misalign::solver {

/// A solved state and its rates.
struct WayStation {
  FoldState<double> state;
  std::vector<double> rates;  ///< one per unknown, rad per unit of x
};

/// Pilot angle and coordinate.
struct WayCoordinate {
  double limit_rad;  ///< the fold limit; 0: there is none

  double pilot_rad(double x) const;
  double pilot_rate(double x) const;  ///< rad per unit of x
  double x_of(double pilot_rad) const;
};

class FoldingWay {
 public:
  /// The k-th station lies at (k + 1/2) `step`; there are at least SmoothTable::kPoints. See
  /// solve_way. `mechanism` must outlive this object.
  FoldingWay(const Mechanism& mechanism, const FlatVertices& drawn_mm,
             const WayCoordinate& coordinate, double step, double end,
             std::vector<WayStation> stations);

  const Mechanism& mechanism() const { return *mechanism_; }
  /// The flat sheet in the frame of its geometry and of every pose, A1 at the origin; and the place
  /// of one of its points on the sheet as drawn.
  const FlatVertices& from_a1_mm() const { return from_a1_mm_; }
  Eigen::Vector2d drawn_mm(const Eigen::Vector2d& from_a1_mm) const { return a1_mm_ + from_a1_mm; }
  const SheetGeometry<double>& geometry() const { return geometry_; }
  const std::vector<WayStation>& stations() const { return stations_; }
  double x_of_station(std::size_t k) const { return (static_cast<double>(k) + 0.5) * step_; }

  /// The largest x, and the pilot's angle there.
  double end() const { return end_; }
  double end_deg() const { return pilot_deg(end_); }
  bool ends_at_limit() const;
  /// The pilot's angle where a crease first folds past 180 degrees; none if none does.
  std::optional<double> over_folded_deg() const;
  double pilot_deg(double x) const { return coordinate_.pilot_rad(x) / kRadPerDeg; }
  double pilot_rate(double x) const { return coordinate_.pilot_rate(x); }
  /// Takes pilot angles from -end_deg() to end_deg().
  double x_of(double pilot_deg) const { return coordinate_.x_of(pilot_deg * kRadPerDeg); }

  /// Lengths (mm) of the diagonals, flat and at x, and rates per unit of x.
  const Eigen::VectorXd& flat_mm() const { return flat_mm_; }
  void find_lengths(double x, Eigen::VectorXd& lengths_mm, Eigen::VectorXd& rates_mm) const;
  /// Fold angles of the creases (rad), and rates per unit of x.
  void find_creases(double x, Eigen::VectorXd& angles_rad, Eigen::VectorXd& rates) const;
  /// Angular speed of each ball joint, rad per unit of x; not negative.
  void find_balls(double x, Eigen::VectorXd& speeds) const;
  /// The rate of every unknown, rad per unit of x.
  void find_rates(double x, Eigen::VectorXd& rates) const;
  /// Turns of all joints at x; `state` has its size already.
  void find_state(double x, FoldState<double>& state) const;

  /// Makes functions of x from values at the stations, a row each.
  SmoothTable table(const Eigen::MatrixXd& at_stations,
                    std::vector<SmoothTable::Parity> parities) const {
    return {at_stations, std::move(parities), step_};
  }

 private:
  Eigen::Index diagonals() const { return flat_mm_.size(); }
  Eigen::Index creases() const { return static_cast<Eigen::Index>(mechanism_->creases.size()); }
  Eigen::Index balls() const { return static_cast<Eigen::Index>(mechanism_->balls.size()); }
  Eigen::Index odd_lengths() const { return mechanism_->springs.in_mid_plane() ? 0 : diagonals(); }
  SmoothTable table_of_joints() const;

  const Mechanism* mechanism_;
  Eigen::Vector2d a1_mm_;
  FlatVertices from_a1_mm_;
  SheetGeometry<double> geometry_;
  WayCoordinate coordinate_;
  double step_, end_;
  std::vector<WayStation> stations_;
  Eigen::VectorXd flat_mm_;
  // Lengths (mm), fold angles (rad), quaternions of the ball joints; then, of lengths that are not
  // even in x, the odd part.
  SmoothTable joints_;
  mutable Eigen::VectorXd quaternions_, quaternion_rates_, odd_, odd_rates_;
};

/// This many stations keep the polynomials' error below 1e-11 panel widths or radians
/// (tests/solver/sheet/folding_way_test.cpp).
inline constexpr int kWayStations = 60;

}  // namespace misalign::solver
