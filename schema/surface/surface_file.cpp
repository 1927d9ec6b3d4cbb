#include "schema/surface/surface_file.hpp"

#include "schema/surface/sheet_check.hpp"

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

}  // namespace misalign::schema
