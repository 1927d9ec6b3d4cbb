#include "solver/target/mesh_surface.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <unsupported/Eigen/BVH>
#include <vector>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using Height = HeightField::Height;
using Box = Eigen::AlignedBox2d;
using Tree = Eigen::KdBVH<double, 2, int>;
// Slope by x and y; then the bend by xx, xy and yy.
using Quadric = Eigen::Matrix<double, 5, 1>;

// Reach of a vertex over its longest edge. Any place of a triangle is nearer to one of its corners
// than 0.58 of its longest edge.
constexpr double kReach = 1;
// A bend counts this much in the fit of a vertex that has too few neighbours for its quadric.
constexpr double kBendWeight = 1e-3;
// Share of the vertices whose bends are below the surface's curvature: a kink somewhere is none.
constexpr double kCommon = 0.95;

Height height_of(const Quadric& quadric, double at_mm, const Vector2d& away_mm) {
  Matrix2d bend;
  bend << quadric(2), quadric(3), quadric(3), quadric(4);
  const Vector2d slope = quadric.head<2>() + bend * away_mm;
  return {at_mm + (quadric.head<2>() + slope).dot(away_mm) / 2, slope, bend};
}

// The quadric at a vertex, from places and heights relative to it. Rows are divided by squares of
// distances.
Quadric fitted_quadric(const Matrix2Xd& away_mm, const VectorXd& above_mm, double edge_mm) {
  Eigen::Matrix<double, Eigen::Dynamic, 5> rows(away_mm.cols(), 5);
  const Quadric unit = (Quadric() << Vector2d::Constant(1 / edge_mm),
                        Eigen::Vector3d::Constant(kBendWeight / (edge_mm * edge_mm)))
                           .finished();
  VectorXd weights = away_mm.colwise().squaredNorm().cwiseInverse();
  for (Index k = 0; k < rows.rows(); ++k) {
    const double x = away_mm(0, k), y = away_mm(1, k);
    rows.row(k) << x, y, x * x / 2, x * y, y * y / 2;
  }
  const Eigen::MatrixXd scaled = weights.asDiagonal() * rows * unit.asDiagonal();
  return unit.cwiseProduct(
      scaled.completeOrthogonalDecomposition().solve(weights.cwiseProduct(above_mm)));
}

// The place of a mesh that is nearest to another, and the projection on its rim there: the identity
// within the mesh, zero at a corner.
struct NearestPlace {
  using Scalar = double;

  double minimumOnVolume(const Box& box) const { return box.squaredExteriorDistance(to_mm); }
  double minimumOnObject(int triangle) {
    const Eigen::Matrix<double, 2, 3> corners_mm = places_mm(Eigen::all, triangles.col(triangle));
    bool is_left = true, is_right = true;
    for (Index k = 0; k < 3; ++k) {
      const Vector2d side_mm = corners_mm.col((k + 1) % 3) - corners_mm.col(k);
      const Vector2d away_mm = to_mm - corners_mm.col(k);
      const double area_mm2 = side_mm.x() * away_mm.y() - side_mm.y() * away_mm.x();
      is_left = is_left && area_mm2 >= 0;
      is_right = is_right && area_mm2 <= 0;
      const double square_mm2 = side_mm.squaredNorm();
      const double share = square_mm2 > 0 ? side_mm.dot(away_mm) / square_mm2 : 0;
      if (share <= 0) {
        take(corners_mm.col(k), Matrix2d::Zero());
      } else if (share < 1) {
        take(corners_mm.col(k) + share * side_mm, side_mm * side_mm.transpose() / square_mm2);
      }
    }
    if (is_left || is_right) take(to_mm, Matrix2d::Identity());
    return (place_mm - to_mm).squaredNorm();
  }
  void take(const Vector2d& candidate_mm, const Matrix2d& along_rim) {
    if (!((candidate_mm - to_mm).squaredNorm() < (place_mm - to_mm).squaredNorm())) return;
    place_mm = candidate_mm;
    along = along_rim;
  }

  const Matrix2Xd& places_mm;
  const Eigen::Matrix3Xi& triangles;
  Vector2d to_mm;
  Vector2d place_mm = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Matrix2d along = Matrix2d::Identity();
};

// A mesh above the plane with its quadrics.
class Blend {
 public:
  Blend(const Eigen::Matrix3Xd& vertices_mm, const Eigen::Matrix3Xi& triangles)
      : places_mm_(vertices_mm.topRows<2>()),
        heights_mm_(vertices_mm.row(2)),
        triangles_(triangles),
        reaches_mm_(VectorXd::Zero(vertices_mm.cols())),
        quadrics_(static_cast<std::size_t>(vertices_mm.cols())) {
    fit();
    plant();
  }

  /// Height at a place of the mesh; elsewhere the mesh's nearest goes straight on.
  Height at(const Vector2d& place_mm) const {
    NearestPlace nearest{places_mm_, triangles_, place_mm};
    Eigen::BVMinimize(in_triangles_, nearest);
    Height height = blended(nearest.place_mm);
    const Vector2d beyond_mm = place_mm - nearest.place_mm;
    height.mm += height.slope.dot(beyond_mm);
    height.slope += nearest.along * height.bend_per_mm * beyond_mm;
    height.bend_per_mm = nearest.along * height.bend_per_mm * nearest.along;
    return height;
  }

  double curvature_per_mm() const {
    std::vector<double> bends;
    for (const Quadric& quadric : quadrics_) {
      bends.push_back(height_of(quadric, 0, Vector2d::Zero()).bend_per_mm.norm());
    }
    const auto at = bends.begin() +
                    static_cast<std::ptrdiff_t>(kCommon * static_cast<double>(bends.size() - 1));
    std::ranges::nth_element(bends, at);
    return *at;
  }

 private:
  // The sum of weights times quadrics over the sum of weights, and its derivatives.
  struct Sums {
    double weights = 0, heights_mm = 0;
    Vector2d by_weights = Vector2d::Zero(), by_heights = Vector2d::Zero();
    Matrix2d more_weights = Matrix2d::Zero(), more_heights = Matrix2d::Zero();
  };
  struct Covering {
    bool intersectVolume(const Box& box) const { return box.contains(place_mm); }
    bool intersectObject(int vertex) {
      mesh.add(vertex, place_mm, sums);
      return false;
    }
    const Blend& mesh;
    Vector2d place_mm;
    Sums sums = {};
  };

  void fit() {
    std::vector<std::set<int>> beside(quadrics_.size());
    for (const auto& triangle : triangles_.colwise()) {
      for (const int a : triangle)
        beside[static_cast<std::size_t>(a)].insert(triangle.begin(), triangle.end());
    }
    for (std::size_t v = 0; v < quadrics_.size(); ++v) {
      const auto at = static_cast<Index>(v);
      std::set<int> around;
      for (const int a : beside[v]) {
        around.insert(beside[static_cast<std::size_t>(a)].begin(),
                      beside[static_cast<std::size_t>(a)].end());
        reaches_mm_(at) =
            std::max(reaches_mm_(at), kReach * (places_mm_.col(a) - places_mm_.col(at)).norm());
      }
      std::erase_if(around, [&](int a) { return places_mm_.col(a) == places_mm_.col(at); });
      const std::vector<int> others(around.begin(), around.end());
      quadrics_[v] = fitted_quadric(places_mm_(Eigen::all, others).colwise() - places_mm_.col(at),
                                    heights_mm_(others).array() - heights_mm_(at), reaches_mm_(at));
    }
  }

  void plant() {
    std::vector<int> vertices(quadrics_.size()), all(static_cast<std::size_t>(triangles_.cols()));
    std::iota(vertices.begin(), vertices.end(), 0);
    std::iota(all.begin(), all.end(), 0);
    std::vector<Box> reach, boxes;
    for (const int v : vertices) {
      const Vector2d half_mm = Vector2d::Constant(reaches_mm_(v));
      reach.emplace_back(places_mm_.col(v) - half_mm, places_mm_.col(v) + half_mm);
    }
    for (const auto& triangle : triangles_.colwise()) {
      Box& box = boxes.emplace_back();
      for (const int v : triangle) box.extend(places_mm_.col(v));
    }
    by_reach_.init(vertices.begin(), vertices.end(), reach.begin(), reach.end());
    in_triangles_.init(all.begin(), all.end(), boxes.begin(), boxes.end());
  }

  // Weights are (1 - t^2)^3 at the share t of the reach: their second derivatives are continuous.
  void add(int vertex, const Vector2d& place_mm, Sums& sums) const {
    const double square_mm2 = reaches_mm_(vertex) * reaches_mm_(vertex);
    const Vector2d away_mm = place_mm - places_mm_.col(vertex);
    const double left = 1 - away_mm.squaredNorm() / square_mm2;
    if (!(left > 0)) return;
    const Height height =
        height_of(quadrics_[static_cast<std::size_t>(vertex)], heights_mm_(vertex), away_mm);
    const double weight = left * left * left;
    const Vector2d slope = -6 * left * left / square_mm2 * away_mm;
    const Matrix2d bend = 24 * left / (square_mm2 * square_mm2) * away_mm * away_mm.transpose() -
                          6 * left * left / square_mm2 * Matrix2d::Identity();
    const Matrix2d cross = slope * height.slope.transpose();
    sums.weights += weight;
    sums.by_weights += slope;
    sums.more_weights += bend;
    sums.heights_mm += weight * height.mm;
    sums.by_heights += weight * height.slope + height.mm * slope;
    sums.more_heights += weight * height.bend_per_mm + cross + cross.transpose() + height.mm * bend;
  }

  Height blended(const Vector2d& place_mm) const {
    Covering covering{*this, place_mm};
    Eigen::BVIntersect(by_reach_, covering);
    const Sums& sums = covering.sums;
    const double mm = sums.heights_mm / sums.weights;
    const Vector2d slope = (sums.by_heights - mm * sums.by_weights) / sums.weights;
    const Matrix2d cross = slope * sums.by_weights.transpose();
    return {
        mm, slope,
        (sums.more_heights - cross - cross.transpose() - mm * sums.more_weights) / sums.weights};
  }

  Matrix2Xd places_mm_;
  VectorXd heights_mm_;
  Eigen::Matrix3Xi triangles_;
  VectorXd reaches_mm_;
  std::vector<Quadric> quadrics_;
  Tree by_reach_, in_triangles_;
};

class MeshSurface final : public HeightField {
 public:
  MeshSurface(std::shared_ptr<const Blend> blend, double share)
      : blend_(std::move(blend)), share_(share) {}
  std::unique_ptr<TargetSurface> scaled(double share) const override {
    return std::make_unique<MeshSurface>(blend_, share * share_);
  }
  double curvature_per_mm() const override { return share_ * blend_->curvature_per_mm(); }

 private:
  Height at(const Vector2d& place_mm) const override {
    const Height height = blend_->at(place_mm);
    return {share_ * height.mm, share_ * height.slope, share_ * height.bend_per_mm};
  }

  std::shared_ptr<const Blend> blend_;
  double share_;
};

}  // namespace

std::unique_ptr<TargetSurface> mesh_surface(const Eigen::Matrix3Xd& vertices_mm,
                                            const Eigen::Matrix3Xi& triangles) {
  assert(triangles.cols() > 0 && triangles.minCoeff() >= 0 &&
         triangles.maxCoeff() < vertices_mm.cols());
  return std::make_unique<MeshSurface>(std::make_shared<const Blend>(vertices_mm, triangles), 1.0);
}

}  // namespace misalign::solver
