// The triangle mesh of a surface, made of polygons.
#pragma once

#include <optional>

#include "schema/surface/polygon_list.hpp"

namespace misalign::schema {

struct TriangleMesh {
  Eigen::Matrix3Xd vertices_mm;
  Eigen::Matrix3Xi triangles;
};

/// Returns polygons as triangles: points in one place are one vertex, polygons are split, triangles
/// with two corners in one place are left out, and so are points without a triangle. Faults:
/// coordinates that are not finite, corners that are no points, no or too many faces.
std::optional<TriangleMesh> triangle_mesh(const PolygonList& polygons, InputFaults& faults);

}  // namespace misalign::schema
