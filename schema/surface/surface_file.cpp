#include "schema/surface/surface_file.hpp"

#include "schema/surface/sheet_check.hpp"
#include "solver/target/mesh_surface.hpp"

namespace misalign::schema {

std::optional<TriangleMesh> read_surface_mesh(std::string_view bytes, const std::string& name,
                                              InputFaults& faults) {
  const std::size_t before = faults.count();
  const PolygonList polygons = read_polygons(bytes, name, faults);
  return faults.count() > before ? std::nullopt : surface_mesh(polygons, faults);
}

std::optional<TriangleMesh> surface_mesh(const PolygonList& polygons, InputFaults& faults) {
  const std::size_t before = faults.count();
  auto mesh = triangle_mesh(polygons, faults);
  if (mesh) find_sheet_faults(*mesh, faults);
  return faults.count() > before ? std::nullopt : std::move(mesh);
}

TriangleMesh read_surface_mesh_file(const std::string& path, FileKind kind) {
  InputFaults faults;
  auto mesh = read_surface_mesh(read_input_file(path, kind), path, faults);
  faults.refuse(path);
  return std::move(*mesh);
}

std::shared_ptr<const solver::TargetSurface> read_surface_file(const std::string& path,
                                                               FileKind kind) {
  const TriangleMesh mesh = read_surface_mesh_file(path, kind);
  return solver::mesh_surface(mesh.vertices_mm, mesh.triangles);
}

}  // namespace misalign::schema
