#include "schema/pattern/sheet_plane.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

constexpr int kX = 0, kY = 1, kZ = 2;

Eigen::Vector3d axis(int k) { return Eigen::Vector3d::Unit(k); }

// Returns "x", or "(0.5, 0, 0.866025)": an axis of the sheet in those of the file.
std::string direction_text(const Eigen::Vector3d& direction) {
  for (const int k : {kX, kY, kZ}) {
    if (direction[k] == 1) return {"xyz"[static_cast<std::size_t>(k)]};
  }
  const auto shown = [&](int k) { return std::round(1e6 * direction[k]) / 1e6 + 0.0; };  // no -0
  return fmt::format("({}, {}, {})", shown(kX), shown(kY), shown(kZ));
}

// Fits a plane by least squares, with a horizontal x.
SheetPlane fitted(const SpacePoints& points) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) centre += p / static_cast<double>(points.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) moments += (p - centre) * (p - centre).transpose();
  Eigen::Vector3d normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors().col(0);
  constexpr double kUpright = 1e-6;  // rounding must not turn over an upright plane
  const int last = std::abs(normal.z()) > kUpright ? kZ : std::abs(normal.y()) > kUpright ? kY : kX;
  if (normal[last] < 0) normal = -normal;
  const Eigen::Vector3d x_axis = axis(kZ).cross(normal).normalized();
  return {x_axis, normal.cross(x_axis), normal, normal.dot(centre)};
}

}  // namespace

PlanePoints SheetPlane::flat(const SpacePoints& points) const {
  PlanePoints flat;
  for (const Eigen::Vector3d& p : points) flat.emplace_back(x_axis.dot(p), y_axis.dot(p));
  return flat;
}

std::string SheetPlane::name() const {
  const double sign = normal.minCoeff() == -1 ? -1 : 1;  // y = 2, not -y = -2
  return fmt::format("the plane {} = {:.6g} mm: x and y of the sheet are {} and {} of the file",
                     direction_text(sign * normal), sign * at + 0.0, direction_text(x_axis),
                     direction_text(y_axis));
}

SheetPlane plane_of(const SpacePoints& points, double within) {
  for (const int k : {kZ, kY, kX}) {
    const auto [least, most] =
        std::ranges::minmax_element(points, {}, [k](const Eigen::Vector3d& p) { return p[k]; });
    if ((*most)[k] - (*least)[k] > within) continue;
    return {axis((k + 1) % 3), axis((k + 2) % 3), axis(k), ((*least)[k] + (*most)[k]) / 2};
  }
  return fitted(points);
}

}  // namespace misalign::schema
