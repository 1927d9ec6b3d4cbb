#include "solver/contact/least_box.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <functional>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// First and last steps of a descent.
constexpr double kFirstTurn_deg = 15, kLastTurn_deg = 1e-3;
// Starts beside the principal axes turn by multiples of this about each axis.
constexpr double kBetweenStarts_deg = 30;
// Boxes of points in a plane are compared by area.
constexpr double kThin_mm = 1e-3;

struct Box {
  Matrix3d axes;
  Vector3d sides_mm;

  double volume() const { return (sides_mm.array() + kThin_mm).prod(); }
};

Box box_along(const Matrix3d& axes, const Matrix3Xd& points_mm) {
  assert(axes.isUnitary(1e-9));
  const Matrix3Xd along_mm = axes.transpose() * points_mm;
  return {axes, along_mm.rowwise().maxCoeff() - along_mm.rowwise().minCoeff()};
}

Matrix3d turned_by(const Vector3d& by_deg) {
  const double angle_rad = by_deg.norm() * kRadPerDeg;
  if (angle_rad == 0) return Matrix3d::Identity();
  return AngleAxisd(angle_rad, by_deg.normalized()).toRotationMatrix();
}

// Pattern search: moves to the best neighbour in a cube of rotations, or halves the cube where none
// is better.
Box descended(Box best, const Matrix3Xd& points_mm) {
  for (double step_deg = kFirstTurn_deg; step_deg > kLastTurn_deg;) {
    const Box from = best;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Eigen::Vector3i way(neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1);
      const Box next = box_along(from.axes * turned_by(step_deg * way.cast<double>()), points_mm);
      if (next.volume() < best.volume() * (1 - 1e-12)) best = next;
    }
    if (best.volume() == from.volume()) step_deg /= 2;
  }
  return best;
}

}  // namespace

Vector3d least_box_mm(const Matrix3Xd& points_mm) {
  assert(points_mm.cols() > 0 && points_mm.allFinite());
  const Matrix3Xd centred_mm = points_mm.colwise() - points_mm.rowwise().mean();
  const Matrix3d principal =
      Eigen::JacobiSVD<Matrix3d>(centred_mm * centred_mm.transpose(), Eigen::ComputeFullU)
          .matrixU();
  Box best = descended(box_along(principal, centred_mm), centred_mm);
  for (int start = 1; start < 27; ++start) {
    const int about_x = start % 3, about_y = start / 3 % 3, about_z = start / 9;
    const Matrix3d axes = principal * turned_by({kBetweenStarts_deg * about_x, 0, 0}) *
                          turned_by({0, kBetweenStarts_deg * about_y, 0}) *
                          turned_by({0, 0, kBetweenStarts_deg * about_z});
    const Box box = descended(box_along(axes, centred_mm), centred_mm);
    if (box.volume() < best.volume()) best = box;
  }
  std::ranges::sort(best.sides_mm, std::greater());
  return best.sides_mm;
}

}  // namespace misalign::solver
