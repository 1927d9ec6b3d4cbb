// The motion of a sheet free in space, and its generalised mass, from vertex coordinates alone, for
// tests.
#pragma once

#include <Eigen/Dense>

#include "solver/motion/plates.hpp"
#include "solver/pattern/outline.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// Per unit of a coordinate.
struct CoordinateMotion {
  double mass;                   ///< twice the kinetic energy, t mm^2
  Eigen::Matrix3Xd velocity_mm;  ///< of the vertices
};

/// The panels are two triangles each, on whose corners the velocities are given by two shapes and
/// `apart`, what the coordinate differs by between them; of all rigid motions that one is added
/// that leaves the least energy.
inline CoordinateMotion motion_of_coordinates(const PerforatedSheet& base, const Plates& plates,
                                              const Eigen::Matrix3Xd& before_mm,
                                              const Eigen::Matrix3Xd& after_mm, double apart) {
  const Eigen::Index n = before_mm.cols();
  // Of linear velocities over a triangle: area / 12 times 2 on the diagonal, 1 beside it.
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  const Eigen::Matrix3Xd middle_mm = (before_mm + after_mm) / 2;
  for (const int facet : kept_facets(base.sheet, base.holes)) {
    const auto& c = base.sheet.facets[static_cast<std::size_t>(facet)];
    for (const std::array<int, 3>& triangle :
         {std::array{c[0], c[1], c[2]}, std::array{c[0], c[2], c[3]}}) {
      const Eigen::Vector3d one = middle_mm.col(triangle[1]) - middle_mm.col(triangle[0]);
      const Eigen::Vector3d other = middle_mm.col(triangle[2]) - middle_mm.col(triangle[0]);
      const double share = plates.area_density() * one.cross(other).norm() / 24;
      for (const int i : triangle) {
        for (const int k : triangle) mass(i, k) += (i == k ? 2 : 1) * share;
      }
    }
  }
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(3 * n, 6),
                  all = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Eigen::VectorXd velocity(3 * n);
  for (Eigen::Index v = 0; v < n; ++v) {
    velocity.segment<3>(3 * v) = (after_mm.col(v) - before_mm.col(v)) / apart;
    const Eigen::Vector3d at = middle_mm.col(v) - middle_mm.col(0);
    for (int k = 0; k < 3; ++k) {
      rigid(3 * v + k, k) = 1;
      rigid.block<3, 1>(3 * v, 3 + k) = Eigen::Vector3d::Unit(k).cross(at) / 100;
    }
    for (Eigen::Index w = 0; w < n; ++w) {
      all.block<3, 3>(3 * v, 3 * w) = mass(v, w) * Eigen::Matrix3d::Identity();
    }
  }
  const Eigen::VectorXd best =
      (rigid.transpose() * all * rigid).ldlt().solve(rigid.transpose() * all * velocity);
  const Eigen::VectorXd left = velocity - rigid * best;
  return {left.dot(all * left), Eigen::Matrix3Xd::Map(left.data(), 3, n)};
}

inline double mass_of_coordinates(const PerforatedSheet& base, const Plates& plates,
                                  const Eigen::Matrix3Xd& before_mm,
                                  const Eigen::Matrix3Xd& after_mm, double apart) {
  return motion_of_coordinates(base, plates, before_mm, after_mm, apart).mass;
}

}  // namespace misalign::solver
