// Gives the folded sheet's vertex coordinates, with a check that needs no equation of loop closure:
// rigid panels keep the lengths of their edges and diagonals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/lane_math.hpp"

namespace misalign::solver {

/// Places each vertex by one facet only, reached over a spanning tree of joints, so that an error
/// of closure shows as a changed length in the facets that did not place all of their corners.
class FoldedShape {
 public:
  /// Facets and vertices of a folded sheet, in panel widths, the first kept facet in the plane z =
  /// 0. Poses apply to points of the sheet's geometry (origin A1) only.
  template <class T>
  struct Points {
    std::vector<Pose<T>> facets;
    std::vector<Vec3<T>> vertices;
  };

  /// The velocity of a facet: its point that is at p now moves by spin x p + drift.
  template <class T>
  struct Twist {
    Vec3<T> spin, drift;
  };

  /// A facet that is reached from another over a joint.
  struct Branch {
    Passage joint;
    int parent, facet;
  };

  FoldedShape(const CreasePattern& sheet, const std::vector<int>& holes,
              const Mechanism& mechanism);

  /// Every kept facet but the first, parents before children.
  const std::vector<Branch>& tree() const { return tree_; }

  template <class T>
  void place(const SheetGeometry<T>& geometry, const FoldState<T>& state, Points<T>& points) const {
    points.facets.resize(facets_.size(), Pose<T>::identity());
    points.vertices.resize(placed_by_.size());
    for (const Branch& branch : tree_) {
      points.facets[branch.facet] = points.facets[branch.parent].then_rotate(
          passage_rotation(mechanism_, geometry, state, branch.joint),
          flat_point(geometry, branch.joint.vertex));
    }
    for (int v = 0; v < static_cast<int>(placed_by_.size()); ++v) {
      points.vertices[v] = points.facets[placed_by_[v]] * flat_point(geometry, v);
    }
  }

  /// Velocity of each facet relative to the first kept one, while every unknown changes at its
  /// rate, in the unit of `rates`; `points` are those of `place` at this state.
  template <class T>
  void move(const SheetGeometry<T>& geometry, const Points<T>& points, const T* rates,
            std::vector<Twist<T>>& twists) const {
    const Vec3<T> at_rest{T(0), T(0), T(0)};
    twists.assign(facets_.size(), {at_rest, at_rest});
    for (const Branch& branch : tree_) {
      detail::LoopScrews<T> screws;
      detail::gather(mechanism_, geometry, branch.joint, points.facets[branch.parent],
                     points.facets[branch.facet], screws);
      const T* rate = rates + mechanism_.first_column(branch.joint);
      Twist<T> twist = twists[branch.parent];
      for (int k = 0; k < screws.count; ++k) {
        const Vec3<T> turn = rate[k] * screws.axis[k];
        twist.spin = twist.spin + turn;
        twist.drift = twist.drift - cross(turn, screws.point[k]);
      }
      twists[branch.facet] = twist;
    }
  }

  /// Rate of change of the distance between two vertices, in panel widths per unit of `twists`.
  template <class T>
  T distance_rate(const Points<T>& points, const std::vector<Twist<T>>& twists, int v,
                  int w) const {
    const auto velocity = [&](int at) {
      const Twist<T>& twist = twists[placed_by_[at]];
      return cross(twist.spin, points.vertices[at]) + twist.drift;
    };
    const Vec3<T> along = points.vertices[v] - points.vertices[w];
    return dot(along, velocity(v) - velocity(w)) / distance(points.vertices[v], points.vertices[w]);
  }

  /// Largest change of any edge or diagonal of a kept facet between flat and folded, panel widths.
  template <class T>
  T isometry_error(const SheetGeometry<T>& geometry, const Points<T>& points) const {
    T worst(0);
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!kept_[f]) continue;
      for (int i = 0; i < 4; ++i) {
        for (int k = i + 1; k < 4; ++k) {
          const int a = facets_[f][i], b = facets_[f][k];
          const T flat = distance(flat_point(geometry, a), flat_point(geometry, b));
          const T change = distance(points.vertices[a], points.vertices[b]) - flat;
          worst = larger(worst, magnitude(change));
        }
      }
    }
    return worst;
  }

  /// 3 x N vertex coordinates in mm, valleys and mountains as seen from +z.
  Eigen::Matrix3Xd vertices_mm(const SheetGeometry<double>& geometry,
                               const FoldState<double>& state) const;

  /// 3 x (4 kept facets) coordinates in mm of the corners of each kept facet in turn, placed by
  /// that facet: where facets meet they agree as well as the joints between them close.
  Eigen::Matrix3Xd corners_mm(const SheetGeometry<double>& geometry,
                              const FoldState<double>& state) const;

 private:
  Eigen::Vector3d seen_mm(const Vec3<double>& point) const;

  const Mechanism& mechanism_;
  std::vector<std::array<int, 4>> facets_;
  std::vector<bool> kept_;
  int root_ = 0;
  std::vector<Branch> tree_;    // parents before children
  std::vector<int> placed_by_;  // facet per vertex
};

}  // namespace misalign::solver
