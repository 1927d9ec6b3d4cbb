#include "schema/carried_pattern.hpp"

#include <cmath>

#include "solver/outline.hpp"

namespace misalign::schema {
namespace {

bool is_at(const Json& point, const Eigen::Vector2d& place_mm) {
  constexpr double kSame_mm = 1e-9;
  return point.is_array() && point.size() >= 2 && point[0].is_number() && point[1].is_number() &&
         std::abs(point[0].get<double>() - place_mm.x()) <= kSame_mm &&
         std::abs(point[1].get<double>() - place_mm.y()) <= kSame_mm;
}

bool is_mesh_of(const Pattern& pattern, const Json& fold) {
  const Eigen::Matrix2Xd vertices_mm = pattern.vertices_mm();
  const Json points = fold.value("vertices_coords", Json());
  if (!points.is_array() || points.size() != static_cast<std::size_t>(vertices_mm.cols())) {
    return false;
  }
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    if (!is_at(points[static_cast<std::size_t>(v)], vertices_mm.col(v))) return false;
  }
  return fold.value("faces_vertices", Json()) == faces_json(pattern);
}

}  // namespace

Json faces_json(const Pattern& pattern) {
  Json faces = Json::array();
  for (const int f : solver::kept_facets(pattern.base.sheet, pattern.base.holes)) {
    faces.push_back(pattern.base.sheet.facets[f]);
  }
  return faces;
}

Pattern read_carried_pattern(const Json& fold, InputFaults& faults, Perforations perforations) {
  const std::size_t before = faults.sentences().size();
  Pattern pattern = read_pattern(fold.at(kCarriedPattern), kCarriedPattern, Displacements::allowed,
                                 {}, faults, perforations);
  if (faults.sentences().size() == before && !is_mesh_of(pattern, fold)) {
    faults.add(kCarriedPattern,
               "is not the pattern of this file's vertices and faces, which were changed since",
               "export the candidate again, or take the key out to read the mesh as it is");
  }
  return pattern;
}

}  // namespace misalign::schema
