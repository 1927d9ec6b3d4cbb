#include "solver/bending/elastic_panel.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d cross_with(const Vector3d& a) {
  Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

}  // namespace

// The shear angle of a parallelogram with sides a, b and diagonals d1, d2, from d2^2 - d1^2 = -4 a
// b cos, without the part of longer sides.
ElasticPanel::ElasticPanel(const std::array<Eigen::Vector2d, 4>& corners_mm,
                           const std::array<bool, 4>& is_straight, const PanelMaterial& material,
                           double thickness_mm, double stiffer)
    : corners_mm_(corners_mm),
      is_straight_(is_straight),
      material_(material),
      thickness_mm_(thickness_mm) {
  const double e = material.e_mpa(), nu = material.poisson, t = thickness_mm;
  const SaddlePlate saddle = bend_into_saddle(corners_mm, is_straight, nu);
  area_mm2_ = saddle.area_mm2;
  const double thin = 1 + kFreeEdge * t * saddle.perimeter_mm / saddle.area_mm2;
  saddle_n_per_mm_ = e * t * t * t / 12 / (1 - nu * nu) * saddle.stiffness / thin;
  const double modulus_n_per_mm = stiffer * e * t;
  const Eigen::Vector2d diagonal_a = corners_mm[2] - corners_mm[0],
                        diagonal_b = corners_mm[3] - corners_mm[1];
  const double cotangent = (diagonal_a.squaredNorm() - diagonal_b.squaredNorm()) / (4 * area_mm2_);
  for (int i = 0; i < 6; ++i) {
    const int from = i < 4 ? i : i - 4, to = i < 4 ? (i + 1) % 4 : i - 2;
    const double length = (corners_mm[to] - corners_mm[from]).norm();
    bars_[i] = {from, to, length};
    if (i < 4) {
      side_n_per_mm_[i] = kEdgeShare * modulus_n_per_mm * area_mm2_ / (length * length);
      shear_[i] = cotangent / (4 * length * length);
    }
  }
  shear_[4] = -1 / (4 * area_mm2_);
  shear_[5] = 1 / (4 * area_mm2_);
  stretch_n_per_mm3_ = modulus_n_per_mm * volume_under_clamped(corners_mm) / std::pow(area_mm2_, 4);
  shear_n_mm_ = modulus_n_per_mm / (2 * (1 + nu)) * area_mm2_;
}

double ElasticPanel::stress_mpa_per_mm() const {
  const double nu = material_.poisson;
  return material_.e_mpa() * thickness_mm_ / 2 / (1 - nu * nu) *
         saddle_stress(corners_mm_, is_straight_, nu, kStressDegree);
}

// Six times the volume between the corners over the area.
ElasticPanel::Function ElasticPanel::saddle(const Corners& p) const {
  const double factor = 1 / area_mm2_;
  const Vector3d a = p.col(1) - p.col(0), b = p.col(2) - p.col(0), c = p.col(3) - p.col(0);
  Function saddle;
  saddle.value = factor * a.dot(b.cross(c));
  const std::array<Vector3d, 3> slopes{b.cross(c), c.cross(a), a.cross(b)};
  const std::array<Vector3d, 3> arms{a, b, c};
  for (int i = 0; i < 3; ++i) {
    saddle.slope.segment<3>(3 * (i + 1)) = factor * slopes[i];
    saddle.slope.head<3>() -= factor * slopes[i];
    const int next = (i + 1) % 3, third = (i + 2) % 3;
    const Matrix3d block = -factor * cross_with(arms[third]);  // d(slope i) / d(next)
    saddle.bend.block<3, 3>(3 * (i + 1), 3 * (next + 1)) = block;
    saddle.bend.block<3, 3>(3 * (next + 1), 3 * (i + 1)) = block.transpose();
  }
  for (int i = 1; i < 4; ++i) {  // the same for all moved together
    const Matrix3d sum = saddle.bend.block<3, 3>(3 * i, 3) + saddle.bend.block<3, 3>(3 * i, 6) +
                         saddle.bend.block<3, 3>(3 * i, 9);
    saddle.bend.block<3, 3>(3 * i, 0) = -sum;
    saddle.bend.block<3, 3>(0, 3 * i) = -sum.transpose();
    saddle.bend.block<3, 3>(0, 0) += sum;
  }
  return saddle;
}

ElasticPanel::Squares ElasticPanel::squares_mm2(const Corners& p, const Corners& moved) const {
  Squares squares;
  for (int i = 0; i < 6; ++i) {
    const auto [tail, head, flat_mm] = bars_[i];
    const Vector3d along = p.col(head) - p.col(tail);
    squares(i) = along.dot(along + 2 * (moved.col(head) - moved.col(tail))) - flat_mm * flat_mm;
  }
  return squares;
}

// Sides stretch by their squares / 2 flat, the shear is a weighted sum of all squares.
ElasticPanel::Function ElasticPanel::energy(const Corners& p, const Squares& squares_mm2) const {
  const Function bent = saddle(p);
  const double q = bent.value, q2 = q * q;
  const Squares real_mm2 = this->squares_mm2(p, Corners::Zero());
  const Eigen::Map<const Squares> shears(shear_.data());
  const double shear_n = shear_n_mm_ * shears.dot(real_mm2);
  Function energy;
  energy.value =
      (saddle_n_per_mm_ + stretch_n_per_mm3_ * q2) * q2 / 2 + shear_n / 2 * shears.dot(real_mm2);
  const double bent_n = (saddle_n_per_mm_ + 2 * stretch_n_per_mm3_ * q2) * q;
  energy.slope = bent_n * bent.slope;
  Eigen::Matrix<double, 12, 1> shear_slope = Eigen::Matrix<double, 12, 1>::Zero();
  for (int i = 0; i < 6; ++i) {
    const auto [tail, head, flat_mm] = bars_[i];
    const Vector3d along = 2 * (p.col(head) - p.col(tail));
    const double side = i < 4 ? side_n_per_mm_[i] / (4 * flat_mm * flat_mm) : 0;
    energy.value += side / 2 * real_mm2(i) * real_mm2(i);
    const Vector3d pull = (side * real_mm2(i) + shear_n * shear_[i]) * along;
    energy.slope.segment<3>(3 * head) += pull;
    energy.slope.segment<3>(3 * tail) -= pull;
    shear_slope.segment<3>(3 * head) += shear_[i] * along;
    shear_slope.segment<3>(3 * tail) -= shear_[i] * along;
    const double force = side * squares_mm2(i) + shear_n_mm_ * shears.dot(squares_mm2) * shear_[i];
    add_ends(head, tail, head, tail,
             side * along * along.transpose() + 2 * force * Matrix3d::Identity(), energy.bend);
  }
  energy.bend +=
      bent_n * bent.bend +
      (saddle_n_per_mm_ + 6 * stretch_n_per_mm3_ * q2) * bent.slope * bent.slope.transpose() +
      shear_n_mm_ * shear_slope * shear_slope.transpose();
  return energy;
}

}  // namespace misalign::solver
