// Reads the triangle mesh of a target surface: OBJ, STL or PLY.
#pragma once

#include <optional>
#include <string>

#include "schema/surface/triangle_mesh.hpp"

namespace misalign::schema {

/// Reads the mesh of a file's bytes, in mm with z up: OBJ, STL or PLY, text or binary, with
/// polygons of any number of corners. It must be a single sheet with one height over each place,
/// without holes (sheet_check.hpp). `name` may end in ".stl". None after a fault.
std::optional<TriangleMesh> read_surface_mesh(std::string_view bytes, const std::string& name,
                                              InputFaults& faults);

/// The same of points and polygons that are known.
std::optional<TriangleMesh> surface_mesh(const PolygonList& polygons, InputFaults& faults);

}  // namespace misalign::schema
