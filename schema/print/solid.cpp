#include "schema/print/solid.hpp"

#include <cmath>
#include <utility>

#include "schema/print/triangulation.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector3d;

}  // namespace

void SolidMaker::add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const std::array<int, 3> corners = {number_of(a), number_of(b), number_of(c)};
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
  solid_.triangles.push_back(corners);
}

void SolidMaker::add(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  add(a, b, c);
  add(a, c, d);
}

void SolidMaker::add(const std::vector<PlanePoints>& rings, const Vector3d& origin,
                     const Vector3d& across, const Vector3d& along) {
  std::vector<Vector3d> points;
  for (const PlanePoints& ring : rings) {
    for (const Eigen::Vector2d& p : ring)
      points.emplace_back(origin + p.x() * across + p.y() * along);
  }
  const auto at = [&](int point) { return points[static_cast<std::size_t>(point)]; };
  for (const auto& [a, b, c] : triangulated(rings)) add(at(a), at(b), at(c));
}

Solid SolidMaker::solid(std::string name) && {
  solid_.name = std::move(name);
  return std::move(solid_);
}

int SolidMaker::number_of(const Vector3d& point) {
  constexpr double kPerMm = 1e6;
  const auto rounded = [](double mm) { return std::round(mm * kPerMm) / kPerMm + 0.0; };
  const Vector3d at(rounded(point.x()), rounded(point.y()), rounded(point.z()));
  const auto [entry, is_new] =
      numbers_.try_emplace({at.x(), at.y(), at.z()}, static_cast<int>(solid_.vertices_mm.size()));
  if (is_new) solid_.vertices_mm.push_back(at);
  return entry->second;
}

}  // namespace misalign::schema
