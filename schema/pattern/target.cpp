#include "schema/pattern/target.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "schema/files/json_values.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "schema/surface/surface_file.hpp"
#include "solver/target/mesh_surface.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

constexpr char kTargetForms[] =
    R"(write {"surface": "sphere", "radius_mm": 1440}, or "plane", "cylinder", "saddle", "helicoid", )"
    R"("grid" or "mesh"; or {"vertices_mm": {"A1": [0, 0, 0], ...}})";
constexpr char kGridForm[] = R"(write rows of numbers, y ascending, such as [[0, 1], [1, 0]])";
constexpr char kPlacesForm[] = R"(write {"A1": [0, 0, 0], "A7": [470, 0, 12], ...})";

// Radii and heights, mm: a sheet is some panels wide.
constexpr double kLeastRadius_mm = 1e-3, kMostHeight_mm = 1e9;

struct MeasuredName {
  const char* name;
  solver::WantedShape::Measured measured;
};
constexpr MeasuredName kMeasured[] = {{"vertices", solver::WantedShape::Measured::vertices},
                                      {"panels", solver::WantedShape::Measured::panels}};

using Surface = std::shared_ptr<const solver::TargetSurface>;

// A radius: positive for a dome, negative for a bowl.
double read_radius(ObjectReader& reader) {
  double radius_mm = 0;
  reader.require("radius_mm", "write the radius in mm, negative for a bowl");
  reader.number("radius_mm", radius_mm, -kMostHeight_mm, kMostHeight_mm, "write the radius in mm");
  if (reader.find("radius_mm") && std::abs(radius_mm) < kLeastRadius_mm &&
      reader.find("radius_mm")->is_number()) {
    reader.faults().add(reader.shown("radius_mm"), "is no radius of a surface",
                        "write the radius in mm, negative for a bowl");
  }
  return radius_mm == 0 ? 1 : radius_mm;
}

bool is_along_x(ObjectReader& reader) {
  struct AxisName {
    const char* name;
  };
  static constexpr AxisName kAxes[] = {{"x"}, {"y"}};
  reader.require("axis", R"(write "x" or "y", the axis that the cylinder's is parallel to)");
  const auto* const axis =
      read_name(reader, "axis", kAxes, "is no axis of a cylinder", R"(write "x" or "y")");
  return axis == &kAxes[0];
}

Surface read_grid(ObjectReader& reader) {
  double spacing_mm = 1;
  reader.require("spacing_mm", "write the distance of neighbours in mm");
  reader.number("spacing_mm", spacing_mm, kLeastRadius_mm, kMostHeight_mm,
                "write the distance of neighbours in mm");
  reader.require("heights_mm", kGridForm);
  const Json* const rows = reader.find("heights_mm");
  if (!rows) return {};
  const std::size_t columns =
      rows->is_array() && !rows->empty() && rows->front().is_array() ? rows->front().size() : 0;
  if (columns < 2 || rows->size() < 2) {
    reader.faults().add(reader.name("heights_mm"), "is no grid of two rows and columns or more",
                        kGridForm);
    return {};
  }
  Eigen::MatrixXd heights_mm(std::ssize(*rows), static_cast<Index>(columns));
  for (std::size_t row = 0; row < rows->size(); ++row) {
    const Json& values = (*rows)[row];
    if (!are_numbers(values, columns) || std::ranges::any_of(values, [](const Json& mm) {
          return std::abs(mm.get<double>()) > kMostHeight_mm;
        })) {
      reader.faults().add(fmt::format("{}[{}]", reader.name("heights_mm"), row),
                          fmt::format("is no list of {} heights, as the first is", columns),
                          kGridForm);
      return {};
    }
    for (std::size_t k = 0; k < columns; ++k) {
      heights_mm(static_cast<Index>(row), static_cast<Index>(k)) = values[k].get<double>();
    }
  }
  return solver::height_grid(spacing_mm, heights_mm);
}

// Points and triangles that the target itself holds.
std::optional<TriangleMesh> read_mesh_inside(ObjectReader& reader, const Json& points,
                                             const Json& triangles) {
  const auto are_triples = [](const Json& rows) {
    return rows.is_array() &&
           std::ranges::all_of(rows, [](const Json& row) { return are_numbers(row, 3); });
  };
  const auto are_corners = [&](const Json& row) {
    return std::ranges::all_of(row, [&](const Json& corner) {
      return corner.is_number_integer() && corner >= 0 && corner < points.size();
    });
  };
  if (!are_triples(points) || points.size() > kMostPolygons) {
    reader.faults().add(reader.name("points_mm"), "are no places", "write [[x, y, z], ...] in mm");
    return {};
  }
  if (!are_triples(triangles) || !std::ranges::all_of(triangles, are_corners)) {
    reader.faults().add(reader.name("triangles"), "are no triples of indices of points_mm, from 0",
                        "write [[0, 1, 2], ...]");
    return {};
  }
  PolygonList polygons;
  for (const Json& point : points) {
    const auto at = point.get<std::array<double, 3>>();
    polygons.points_mm.emplace_back(at[0], at[1], at[2]);
  }
  polygons.faces = triangles.get<std::vector<std::vector<int>>>();
  return surface_mesh(polygons, reader.faults());
}

// A mesh in a file beside the pattern's, whose whole path `path` becomes, or in the target itself.
std::optional<TriangleMesh> read_mesh(ObjectReader& reader, const std::filesystem::path& directory,
                                      std::string& path) {
  constexpr char kFileForm[] = R"(write the name of an OBJ, STL or PLY file, such as "hull.obj")";
  const Json* const points = reader.find("points_mm");
  const Json* const triangles = reader.find("triangles");
  if (points && triangles && !reader.find("file")) {
    return read_mesh_inside(reader, *points, *triangles);
  }
  if (points || triangles) {
    reader.faults().add(reader.name(points ? "points_mm" : "triangles"),
                        reader.find("file") ? "is given beside a file" : "is half of a mesh",
                        "write points_mm and triangles, or a file");
    return {};
  }
  std::string name;
  reader.require("file", kFileForm);
  reader.text("file", name, kFileForm);
  if (name.empty()) {
    if (reader.find("file") && reader.find("file")->is_string()) {
      reader.faults().add(reader.name("file"), "is no file name", kFileForm);
    }
    return {};
  }
  path = std::filesystem::absolute(directory / name).lexically_normal().string();
  const std::size_t before = reader.faults().count();
  auto mesh = read_surface_mesh(read_input_file(path), path, reader.faults());
  return reader.faults().count() > before ? std::nullopt : std::move(mesh);
}

Surface read_surface(ObjectReader& reader) {
  struct SurfaceName {
    const char* name;
    Surface (*read)(ObjectReader&);
  };
  static constexpr SurfaceName kSurfaces[] = {
      {"plane", [](ObjectReader&) -> Surface { return solver::plane(); }},
      {"cylinder",
       [](ObjectReader& from) -> Surface {
         const double radius_mm = read_radius(from);
         return solver::cylinder(radius_mm, is_along_x(from));
       }},
      {"sphere", [](ObjectReader& from) -> Surface { return solver::sphere(read_radius(from)); }},
      {"saddle", [](ObjectReader& from) -> Surface { return solver::saddle(read_radius(from)); }},
      {"helicoid",
       [](ObjectReader& from) -> Surface { return solver::helicoid(read_radius(from)); }},
      {"grid", read_grid}};
  const auto* const named =
      read_name(reader, "surface", kSurfaces, "is no surface that is known", kTargetForms);
  return named ? named->read(reader) : Surface();
}

// Returns whether these places lie on one line, or are fewer than three.
bool are_on_a_line(const std::vector<solver::WantedShape::Place>& places) {
  if (places.size() < 3) return true;
  Eigen::Matrix3Xd all_mm(3, std::ssize(places));
  for (std::size_t k = 0; k < places.size(); ++k) all_mm.col(static_cast<Index>(k)) = places[k].mm;
  const Eigen::Vector3d widths =
      Eigen::JacobiSVD<Eigen::MatrixXd>(all_mm.colwise() - all_mm.rowwise().mean().eval())
          .singularValues();
  constexpr double kThin = 1e-6;
  return widths(1) <= kThin * widths(0);
}

void read_places(ObjectReader& reader, const solver::CreasePattern& base,
                 std::vector<solver::WantedShape::Place>& places) {
  const Json* const given = reader.find("vertices_mm");
  if (!given) return;
  if (!given->is_object()) {
    return reader.faults().add(reader.shown("vertices_mm"), "is no object of places", kPlacesForm);
  }
  const std::size_t before = reader.faults().count();
  for (const auto& [label, place] : given->items()) {
    const std::string name = reader.name("vertices_mm") + "." + printable(label);
    const int vertex = vertex_of_label(label, base.vertex_count());
    if (vertex < 0) {
      reader.faults().add(name, "is no vertex of this sheet",
                          fmt::format("vertices are A1 to A{}", base.vertex_count()));
    } else if (!are_numbers(place, 3)) {
      reader.faults().add(name, "is no place", "write [x, y, z] in mm");
    } else {
      const auto at = place.get<std::array<double, 3>>();
      places.push_back({vertex, {at[0], at[1], at[2]}});
    }
  }
  if (reader.faults().count() == before && are_on_a_line(places)) {
    reader.faults().add(reader.name("vertices_mm"), "has fewer than three places off one line",
                        kPlacesForm);
  }
}

}  // namespace

Target read_target(const Json& value, const std::string& where, const solver::CreasePattern& base,
                   const std::filesystem::path& directory, InputFaults& faults) {
  Target target;
  target.json = value;
  ObjectReader reader(value, where, faults);
  reader.number("at_deg", target.at_deg, 1, 179.9,
                "write the pilot angle in degrees, or null for where the springs rest");
  const bool has_places = reader.find("vertices_mm");
  if (value.is_object() && has_places == value.contains("surface")) {
    faults.add(where, has_places ? "has a surface and places" : "has no surface and no places",
               kTargetForms);
  }
  if (has_places) {
    read_places(reader, base, target.shape.places);
  } else if (value.is_object() && value.contains("surface")) {
    if (value["surface"] == "mesh") {
      reader.find("surface");
      std::string path;
      if (auto mesh = read_mesh(reader, directory, path)) {
        target.shape.surface = solver::mesh_surface(mesh->vertices_mm, mesh->triangles);
        target.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
      }
      if (!path.empty()) target.json["file"] = path;
    } else {
      target.shape.surface = read_surface(reader);
    }
    const auto* const measured = read_name(reader, "of", kMeasured, "is no part of a sheet",
                                           R"(write "vertices" or "panels")");
    if (measured) target.shape.measured = measured->measured;
    if (!target.shape.surface) return target;  // of an unknown surface no key is known
  }
  reader.refuse_unknown_keys();
  return target;
}

Json with_mesh_inside(const Target& target) {
  assert(target.mesh);
  Json inside = target.json, points = Json::array(), triangles = Json::array();
  for (const auto& at : target.mesh->vertices_mm.colwise()) {
    points.push_back({at.x(), at.y(), at.z()});
  }
  for (const auto& corners : target.mesh->triangles.colwise()) {
    triangles.push_back({corners(0), corners(1), corners(2)});
  }
  inside.erase("file");
  inside["points_mm"] = std::move(points);
  inside["triangles"] = std::move(triangles);
  return inside;
}

std::string target_words(const Target& target) {
  if (!target.shape.surface) {
    return fmt::format("places of {} vertices", target.shape.places.size());
  }
  const auto name = target.json.value("surface", "");
  if (!target.json.contains("radius_mm")) {
    return name == "plane" ? "a plane" : fmt::format("the surface of a {}", name);
  }
  const double radius_mm = target.json["radius_mm"].get<double>();
  std::string words = fmt::format("a {} of radius {:g} mm", name, radius_mm);
  if (name == "cylinder") words += ", its axis along " + target.json.value("axis", "");
  return words;
}

}  // namespace misalign::schema
