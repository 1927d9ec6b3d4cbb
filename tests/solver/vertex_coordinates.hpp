// A second solver for tests: the unknowns are where the vertices lie in space, the equations that
// panels are rigid and flat. It knows no fold angle but the pilot's, no loop, no joint, and follows
// the path by itself.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <vector>

#include "solver/records/history.hpp"

namespace misalign::solver {

/// Four corners are a rigid flat panel when their six distances are those of the flat sheet and the
/// tetrahedron they span has no volume: the distances alone leave it free to warp, to first order.
/// The panel left of the pilot lies where it lay flat, which takes the six motions of a body, and a
/// corner of the other lies in the plane that the pilot's angle gives it. All of it is consistent,
/// so that Gauss-Newton converges as fast as Newton, and to the same, whatever the weights.
class VertexCoordinates {
 public:
  /// `start_mm` is near the solution with the pilot at `start_deg`.
  VertexCoordinates(const PerforatedSheet& base, const FlatVertices& flat_mm,
                    const Eigen::Matrix3Xd& start_mm, double start_deg)
      : unit_mm_(base.sheet.panel_width_mm), side_(base.folding.side()), reached_deg_(start_deg) {
    flat_.setZero(3, flat_mm.cols());
    flat_.topRows<2>() = flat_mm / unit_mm_;
    const Edge& pilot = base.sheet.edges[base.folding.pilot_edge()];
    pilot_ = {pilot.a, pilot.b};
    pinned_ = base.sheet.facets[pilot.left];
    for (int f = 0; f < base.sheet.facet_count(); ++f) {
      if (f != pilot.left && !std::binary_search(base.holes.begin(), base.holes.end(), f)) {
        panels_.push_back(base.sheet.facets[f]);
      }
    }
    for (const int v : base.sheet.facets[pilot.right]) {
      if (v != pilot.a && v != pilot.b) swung_ = v;
    }
    // From wherever the start lies to the pinned panel.
    const Eigen::Matrix3d to_flat = frame(flat_) * frame(start_mm / unit_mm_).transpose();
    points_ = to_flat * (start_mm / unit_mm_);
    points_.colwise() += flat_.col(pilot.a) - points_.col(pilot.a).eval();
    if (!solve(start_deg)) step_deg_ = std::nan("");
    before_ = points_;
  }

  /// Follows the path in steps of a degree, each predicted along the last one's chord; shorter
  /// where that does not converge. False if it found no way on.
  bool fold_to(double pilot_deg) {
    constexpr double kLeast_deg = 1e-6;
    double longest_deg = 1;
    while (reached_deg_ < pilot_deg) {
      if (longest_deg < kLeast_deg) return false;
      const double next_deg = std::min(reached_deg_ + longest_deg, pilot_deg);
      const double ratio = (next_deg - reached_deg_) / step_deg_;
      const Eigen::Matrix3Xd here = points_;
      points_ += ratio * (here - before_);
      if (!solve(next_deg)) {
        points_ = here;
        longest_deg *= 0.5;
        continue;
      }
      before_ = here;
      step_deg_ = next_deg - reached_deg_;
      reached_deg_ = next_deg;
    }
    return true;
  }

  /// From a solution of its own at `from_deg`, with its vertices here, to the one at another angle,
  /// along their rates. False if there is none, or if the way there bends by more than a tenth of
  /// it: then it is still at `from_deg`.
  bool move(const Eigen::Matrix3Xd& from_mm, double from_deg, double to_deg) {
    constexpr double kMostBent = 0.1;
    points_ = from_mm / unit_mm_;
    reached_deg_ = from_deg;
    if (to_deg == from_deg) return true;
    const Eigen::Matrix3Xd from = points_;
    points_ += (to_deg - from_deg) * kRadPerDeg * rates();
    const Eigen::Matrix3Xd foretold = points_;
    const bool solved = solve(to_deg) &&
                        (points_ - foretold).norm() <= kMostBent * (foretold - from).norm() + 1e-12;
    if (solved) {
      reached_deg_ = to_deg;
    } else {
      points_ = from;
    }
    return solved;
  }

  /// How the vertices move at the solution, panel widths per radian of pilot: least squares, and
  /// once more for what their normal equations leave.
  Eigen::Matrix3Xd rates() {
    write_equations(reached_deg_);
    const Eigen::SparseMatrix<double> j = jacobian();
    Eigen::VectorXd by_pilot = Eigen::VectorXd::Zero(rows());
    by_pilot[swung_row_] = swung_by_pilot_;
    factorize(j);
    Eigen::VectorXd rates = Eigen::VectorXd::Zero(points_.size());
    for (int i = 0; i < 4; ++i) rates -= normal_.solve(j.transpose() * (by_pilot + j * rates));
    return Eigen::Map<const Eigen::Matrix3Xd>(rates.data(), 3, points_.cols());
  }

  /// 3 x vertices.
  Eigen::Matrix3Xd points_mm() const { return points_ * unit_mm_; }
  double distance_mm(int v, int w) const {
    return (points_.col(v) - points_.col(w)).norm() * unit_mm_;
  }
  double reached_deg() const { return reached_deg_; }
  double unit_mm() const { return unit_mm_; }

 private:
  // Along the pilot, across it in the pinned panel, and their normal.
  Eigen::Matrix3d frame(const Eigen::Matrix3Xd& points) const {
    const auto corner = [&](int k) -> Eigen::Vector3d { return points.col(pinned_[k]); };
    Eigen::Matrix3d axes;
    axes.col(0) = (points.col(pilot_[1]) - points.col(pilot_[0])).normalized();
    axes.col(2) = (corner(2) - corner(0)).cross(corner(3) - corner(1)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }

  bool solve(double pilot_deg) {
    constexpr double kSolved = 1e-13;  // panel widths; their squares and cubes
    constexpr int kMost = 8;
    for (int i = 0; i < kMost; ++i) {
      write_equations(pilot_deg);
      const Eigen::SparseMatrix<double> j = jacobian();
      const Eigen::VectorXd rest = Eigen::Map<Eigen::VectorXd>(rest_.data(), rows());
      factorize(j);
      const Eigen::VectorXd step = normal_.solve(j.transpose() * rest);
      points_ -= Eigen::Map<const Eigen::Matrix3Xd>(step.data(), 3, points_.cols());
      if (rest.cwiseAbs().maxCoeff() <= kSolved) return true;
    }
    return false;
  }

  void factorize(const Eigen::SparseMatrix<double>& j) {
    const Eigen::SparseMatrix<double> square = j.transpose() * j;
    if (!analysed_) normal_.analyzePattern(square);
    analysed_ = true;
    normal_.factorize(square);
  }

  void write_equations(double pilot_deg) {
    rest_.clear();
    entries_.clear();
    for (const int v : pinned_) {
      for (int k = 0; k < 3; ++k)
        add(v, Eigen::Vector3d::Unit(k)), end(points_(k, v) - flat_(k, v));
    }
    // The normal of the right panel: the left one's turned by minus the fold angle about a -> b.
    const Eigen::Vector3d axis = (flat_.col(pilot_[1]) - flat_.col(pilot_[0])).normalized();
    const Eigen::Vector3d normal =
        Eigen::AngleAxisd(-side_ * pilot_deg * kRadPerDeg, axis) * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d arm = points_.col(swung_) - flat_.col(pilot_[0]);
    swung_row_ = rows();
    swung_by_pilot_ = -side_ * axis.cross(normal).dot(arm);
    add(swung_, normal);
    end(normal.dot(arm));
    for (const auto& panel : panels_) {
      for (int i = 0; i < 4; ++i) {
        for (int k = i + 1; k < 4; ++k) {
          const Eigen::Vector3d apart = points_.col(panel[k]) - points_.col(panel[i]);
          add(panel[k], apart);
          add(panel[i], -apart);
          const double flat = (flat_.col(panel[k]) - flat_.col(panel[i])).squaredNorm();
          end(0.5 * (apart.squaredNorm() - flat));
        }
      }
      const Eigen::Vector3d a = points_.col(panel[1]) - points_.col(panel[0]);
      const Eigen::Vector3d b = points_.col(panel[2]) - points_.col(panel[0]);
      const Eigen::Vector3d c = points_.col(panel[3]) - points_.col(panel[0]);
      const Eigen::Vector3d by_a = b.cross(c), by_b = c.cross(a), by_c = a.cross(b);
      add(panel[0], -(by_a + by_b + by_c));
      add(panel[1], by_a);
      add(panel[2], by_b);
      add(panel[3], by_c);
      end(a.dot(by_a));
    }
  }

  // The equation's gradient by one vertex; its value.
  void add(int vertex, const Eigen::Vector3d& gradient) {
    for (int k = 0; k < 3; ++k) entries_.emplace_back(rows(), 3 * vertex + k, gradient[k]);
  }
  void end(double value) { rest_.push_back(value); }
  int rows() const { return static_cast<int>(rest_.size()); }
  Eigen::SparseMatrix<double> jacobian() const {
    Eigen::SparseMatrix<double> j(rows(), 3 * points_.cols());
    j.setFromTriplets(entries_.begin(), entries_.end());
    return j;
  }

  const double unit_mm_;
  const int side_;
  Eigen::Matrix3Xd flat_, points_, before_;  // panel widths
  std::array<int, 2> pilot_;
  std::array<int, 4> pinned_;
  int swung_ = -1, swung_row_ = 0;
  double swung_by_pilot_ = 0;  // of its equation, per radian
  std::vector<std::array<int, 4>> panels_;
  std::vector<double> rest_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> normal_;
  bool analysed_ = false;
  double reached_deg_, step_deg_ = 1;
};

}  // namespace misalign::solver
