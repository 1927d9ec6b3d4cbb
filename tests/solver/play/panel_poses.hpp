// A second solver for tests of joints with play: the unknowns are where the panels are, the
// equations that what a joint joins lies together. It knows no loop and no fold angle but the
// pilot's.
#pragma once

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <set>
#include <vector>

#include "solver/kinematics/loose_sheet.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// Lengths in mm. Round a whole vertex four hinges have no common solution: one of them, which is
/// on no way round a hole, only has to keep its direction.
class PanelPoses {
 public:
  PanelPoses(const PerforatedSheet& base, const Mechanism& mechanism,
             const FlatVertices& vertices_mm, const JointOffsets& offsets, double backlash_mm)
      : facets_(base.sheet.facets),
        pilot_(mechanism.creases[mechanism.pilot]),
        flat_mm_(3, vertices_mm.cols()) {
    flat_mm_.setZero();
    flat_mm_.topRows<2>() = vertices_mm;
    number_.assign(facets_.size(), -1);
    root_ = pilot_.left;
    int count = 0;
    for (int f = 0; f < base.sheet.facet_count(); ++f) {
      const bool hole = std::find(base.holes.begin(), base.holes.end(), f) != base.holes.end();
      if (!hole && f != root_) number_[f] = count++;
    }
    unknowns_ = 6 * count;
    std::set<int> round_holes, spared;
    for (const Loop& loop : mechanism.loops) {
      for (const Passage& passage : loop.passages) {
        if (loop.hole >= 0 && !passage.ball) round_holes.insert(passage.joint);
      }
    }
    for (const Loop& loop : mechanism.loops) {
      if (loop.hole >= 0) continue;
      for (const Passage& passage : loop.passages) {
        if (round_holes.contains(passage.joint)) continue;
        spared.insert(passage.joint);
        break;
      }
    }
    const auto mm = [&](const Vec3<double>& share) {
      return Eigen::Vector3d(backlash_mm * Eigen::Vector3d(share.x, share.y, share.z));
    };
    for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
      const Crease& crease = mechanism.creases[i];
      const Eigen::Vector3d a = flat_mm_.col(crease.a), b = flat_mm_.col(crease.b);
      const Eigen::Vector3d on_a = a + mm(offsets.creases_a[i]);
      const Eigen::Vector3d line = b + mm(offsets.creases_b[i]) - on_a;
      const int joint = static_cast<int>(i);
      if (!spared.contains(joint)) join(crease.left, on_a, crease.right, a, true);
      join(crease.left, 80 * line.normalized(), crease.right, 80 * (b - a).normalized(), false);
      if (joint == mechanism.pilot) {
        pilot_axis_ = line.normalized();
        pilot_tilt_ = Eigen::Quaterniond::FromTwoVectors(b - a, line);
      }
    }
    for (std::size_t i = 0; i < mechanism.balls.size(); ++i) {
      const BallJoint& ball = mechanism.balls[i];
      const Eigen::Vector3d centre = flat_mm_.col(ball.vertex);
      join(ball.from_facet, centre + mm(offsets.balls[i]), ball.to_facet, centre, true);
    }
    turns_.assign(facets_.size(), Eigen::Matrix3d::Identity());
    moves_.assign(facets_.size(), Eigen::Vector3d::Zero());
  }

  /// Panels as they lie in a folded shape of the sheet as designed.
  void start_from(const Eigen::Matrix3Xd& shape_mm) {
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (number_[f] < 0 && static_cast<int>(f) != root_) continue;
      Eigen::Matrix<double, 3, 4> flat, folded;
      for (int k = 0; k < 4; ++k) {
        flat.col(k) = flat_mm_.col(facets_[f][k]);
        folded.col(k) = shape_mm.col(facets_[f][k]);
      }
      const Eigen::Matrix4d pose = Eigen::umeyama(flat, folded, false);
      turns_[f] = pose.topLeftCorner<3, 3>();
      moves_[f] = pose.topRightCorner<3, 1>();
    }
  }

  /// Gauss-Newton, which converges like Newton where all equations can be met. False if it does
  /// not.
  bool solve(double pilot_deg) {
    const Eigen::Matrix3d right =
        Eigen::AngleAxisd(-pilot_deg * kRadPerDeg, pilot_axis_) * pilot_tilt_.toRotationMatrix();
    for (int i = 0; i < 12; ++i) {
      rest_.clear();
      entries_.clear();
      for (const Joint& joint : joints_) add(joint);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d edge = 80 * Eigen::Vector3d::Unit(k);
        add({pilot_.left, right * edge, pilot_.right, edge, false});
      }
      Eigen::SparseMatrix<double> j(static_cast<Eigen::Index>(rest_.size()), unknowns_);
      j.setFromTriplets(entries_.begin(), entries_.end());
      const Eigen::VectorXd rest =
          Eigen::Map<Eigen::VectorXd>(rest_.data(), static_cast<Eigen::Index>(rest_.size()));
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> normal(
          Eigen::SparseMatrix<double>(j.transpose() * j));
      move(normal.solve(-(j.transpose() * rest)));
      if (rest.cwiseAbs().maxCoeff() < 1e-10) return true;
    }
    return false;
  }

  /// Between two corners, each of one panel.
  double distance_mm(int facet, int vertex, int other_facet, int other_vertex) const {
    return (place(facet, flat_mm_.col(vertex)) - place(other_facet, flat_mm_.col(other_vertex)))
        .norm();
  }
  /// Of a hole's two diagonals: at each corner from the panel before it, counter-clockwise.
  std::array<double, 2> diagonals_mm(int hole) const {
    const auto& corners = facets_[hole];
    std::array<int, 4> panel{};
    for (int k = 0; k < 4; ++k) panel[k] = neighbour(hole, corners[(k + 3) % 4], corners[k]);
    return {distance_mm(panel[1], corners[1], panel[3], corners[3]),
            distance_mm(panel[2], corners[2], panel[0], corners[0])};
  }
  /// Positive where the crease is a valley as seen from +z: sin of its fold angle.
  double sine(const Crease& crease) const {
    const Eigen::Vector3d along = flat_mm_.col(crease.b) - flat_mm_.col(crease.a);
    return -(turns_[crease.left].col(2).cross(turns_[crease.right].col(2)))
                .dot(turns_[crease.left] * along.normalized());
  }

 private:
  struct Joint {
    int f;
    Eigen::Vector3d in_f;
    int g;
    Eigen::Vector3d in_g;
    bool is_point;  // otherwise a direction
  };

  void join(int f, const Eigen::Vector3d& in_f, int g, const Eigen::Vector3d& in_g, bool is_point) {
    joints_.push_back({f, in_f, g, in_g, is_point});
  }

  Eigen::Vector3d place(int f, const Eigen::Vector3d& point) const {
    return turns_[f] * point + moves_[f];
  }

  int neighbour(int hole, int v, int w) const {
    for (int f = 0; f < static_cast<int>(facets_.size()); ++f) {
      const auto has = [&](int vertex) {
        return std::find(facets_[f].begin(), facets_[f].end(), vertex) != facets_[f].end();
      };
      if (f != hole && has(v) && has(w)) return f;
    }
    return -1;
  }

  // What is at `in_g` of g minus what is at `in_f` of f; a turn by w moves R x by w x R x.
  void add(const Joint& joint) {
    const int row = static_cast<int>(rest_.size());
    Eigen::Vector3d apart = Eigen::Vector3d::Zero();
    for (const auto& [facet, point, sign] :
         {std::tuple(joint.g, joint.in_g, 1.0), std::tuple(joint.f, joint.in_f, -1.0)}) {
      const Eigen::Vector3d arm = turns_[facet] * point;
      apart += sign * arm;
      if (joint.is_point) apart += sign * moves_[facet];
      if (number_[facet] < 0) continue;
      const int column = 6 * number_[facet];
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d by_turn = sign * Eigen::Vector3d::Unit(k).cross(arm);
        for (int i = 0; i < 3; ++i) entries_.emplace_back(row + i, column + k, by_turn[i]);
        if (joint.is_point) entries_.emplace_back(row + k, column + 3 + k, sign);
      }
    }
    rest_.insert(rest_.end(), apart.begin(), apart.end());
  }

  void move(const Eigen::VectorXd& step) {
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (number_[f] < 0) continue;
      const Eigen::Vector3d turn = step.segment<3>(6 * number_[f]);
      if (turn.norm() > 0) {
        turns_[f] = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * turns_[f];
      }
      moves_[f] += step.segment<3>(6 * number_[f] + 3);
    }
  }

  std::vector<std::array<int, 4>> facets_;
  Crease pilot_;
  Eigen::Matrix3Xd flat_mm_;
  std::vector<int> number_;  // of a panel that moves
  int root_, unknowns_;
  std::vector<Joint> joints_;
  Eigen::Vector3d pilot_axis_;
  Eigen::Quaterniond pilot_tilt_;
  std::vector<Eigen::Matrix3d> turns_;
  std::vector<Eigen::Vector3d> moves_;
  std::vector<double> rest_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace misalign::solver
