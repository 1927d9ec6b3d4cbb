#include "schema/exchange/plate_stl.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cassert>
#include <iterator>

namespace misalign::schema {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Axes of the panel with these corners, counter-clockwise: along its first edge, across it,
// upwards.
Matrix3d axes_of(const Vector3d& first, const Vector3d& second, const Vector3d& last) {
  const Vector3d along = (second - first).normalized();
  assert(first != second && first != last);
  const Vector3d up = along.cross(last - first).normalized();
  Matrix3d axes;
  axes << along, up.cross(along), up;
  return axes;
}

}  // namespace

std::string plate_stl(const Pattern& base, const solver::Panels& panels,
                      const Eigen::Matrix2Xd& flat_mm,
                      const std::vector<solver::PlateSolid>& solids,
                      const Eigen::Matrix3Xd& shape_mm) {
  std::string text;
  const auto out = std::back_inserter(text);
  assert(solids.size() <= panels.corners.size() && shape_mm.cols() == flat_mm.cols());
  for (std::size_t panel = 0; panel < solids.size(); ++panel) {
    const auto& corners = panels.corners[panel];
    const auto flat = [&](std::size_t k) {
      Vector3d corner = Vector3d::Zero();
      corner.head<2>() = flat_mm.col(corners[k]) - flat_mm.col(0);
      return corner;
    };
    const auto folded = [&](std::size_t k) -> Vector3d { return shape_mm.col(corners[k]); };
    const Matrix3d rotation =
        axes_of(folded(0), folded(1), folded(3)) * axes_of(flat(0), flat(1), flat(3)).transpose();
    const auto& place = base.base.sheet.places[static_cast<std::size_t>(panels.facets[panel])];
    const std::string name = fmt::format("panel_{}_{}", place[0], place[1]);
    fmt::format_to(out, "solid {}\n", name);
    std::vector<Vector3d> vertices_mm;
    for (const Vector3d& vertex : solids[panel].vertices_mm) {
      vertices_mm.push_back(folded(0) + rotation * (vertex - flat(0)));
    }
    for (const std::vector<int>& face : solids[panel].faces) {
      assert(face.size() >= 3);
      for (std::size_t k = 2; k < face.size(); ++k) {
        const std::array<Vector3d, 3> p{vertices_mm[static_cast<std::size_t>(face[0])],
                                        vertices_mm[static_cast<std::size_t>(face[k - 1])],
                                        vertices_mm[static_cast<std::size_t>(face[k])]};
        const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
        fmt::format_to(out, "facet normal {:.6g} {:.6g} {:.6g}\nouter loop\n", normal.x(),
                       normal.y(), normal.z());
        for (const Vector3d& v : p) {
          fmt::format_to(out, "vertex {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
        }
        fmt::format_to(out, "endloop\nendfacet\n");
      }
    }
    fmt::format_to(out, "endsolid {}\n", name);
  }
  return text;
}

}  // namespace misalign::schema
