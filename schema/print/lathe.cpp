#include "schema/print/lathe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "schema/kit/chords.hpp"

namespace misalign::schema {

using Eigen::Vector3d;

Solid lathe(const PlanePoints& profile, const Vector3d& origin, const Vector3d& axis) {
  assert(profile.front().x() == 0 && profile.back().x() == 0);
  const Vector3d across = axis.unitOrthogonal(), along = axis.cross(across);
  double widest_mm = 0;
  for (const Eigen::Vector2d& point : profile) widest_mm = std::max(widest_mm, point.x());
  PlanePoints directions = arc_points({0, 0}, widest_mm, 0, 2 * std::numbers::pi);
  directions.pop_back();  // the first again
  for (Eigen::Vector2d& direction : directions) direction /= widest_mm;
  const auto at = [&](const Eigen::Vector2d& point, std::size_t turn) -> Vector3d {
    const Eigen::Vector2d& direction = directions[turn % directions.size()];
    return origin + point.y() * axis + point.x() * (direction.x() * across + direction.y() * along);
  };
  SolidMaker maker;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    for (std::size_t turn = 0; turn < directions.size(); ++turn) {
      maker.add(at(profile[i], turn), at(profile[i], turn + 1), at(profile[i + 1], turn + 1),
                at(profile[i + 1], turn));
    }
  }
  return std::move(maker).solid("");
}

}  // namespace misalign::schema
