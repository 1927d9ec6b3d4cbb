// Reads a target surface from a file: a triangle mesh in OBJ, STL or PLY.
#pragma once

#include <memory>
#include <string>

#include "schema/surface/triangle_mesh.hpp"
#include "solver/target/target_surface.hpp"

namespace misalign::schema {

/// Reads the mesh of a file's bytes, in mm with z up: OBJ, STL or PLY, text or binary, with
/// polygons of any number of corners. It must be a single sheet with one height over each place,
/// without holes (sheet_check.hpp). `name` may end in ".stl". None after a fault.
std::optional<TriangleMesh> read_surface_mesh(std::string_view bytes, const std::string& name,
                                              InputFaults& faults);

/// The same of points and polygons that are known.
std::optional<TriangleMesh> surface_mesh(const PolygonList& polygons, InputFaults& faults);

/// Reads such a file; UserError (bad_input) if it is missing, unreadable or too large, or with
/// every fault of its mesh. The surface is a solver::mesh_surface.
TriangleMesh read_surface_mesh_file(const std::string& path, FileKind kind = FileKind::any);
std::shared_ptr<const solver::TargetSurface> read_surface_file(const std::string& path,
                                                               FileKind kind = FileKind::any);

}  // namespace misalign::schema
