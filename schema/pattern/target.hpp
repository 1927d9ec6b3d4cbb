// Reads the shape that a folded sheet shall have: "target" of a pattern file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/surface/triangle_mesh.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "solver/target/shape_fit.hpp"

namespace misalign::schema {

/// Pilot angle of a shape, degrees, where neither target nor springs name one.
inline constexpr double kShape_deg = 90;

struct Target {
  solver::WantedShape shape;
  std::optional<double> at_deg;              ///< pilot angle; none: where the filling rests
  Json json;                                 ///< the object read
  std::shared_ptr<const TriangleMesh> mesh;  ///< a mesh surface's; null otherwise
};

/// Reads an object such as {"surface": "sphere", "radius_mm": 1440} at `where`; wrong values are
/// faults, and then its shape is empty. A file that it names is relative to `directory`.
Target read_target(const Json& value, const std::string& where, const solver::CreasePattern& base,
                   const std::filesystem::path& directory, InputFaults& faults);

/// The object of a surface "mesh" with its points and triangles in place of a file.
Json with_mesh_inside(const Target& target);

/// "a sphere of radius 1440 mm": the shape in words.
std::string target_words(const Target& target);

}  // namespace misalign::schema
