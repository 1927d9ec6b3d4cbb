#include "schema/pattern/carried_pattern.hpp"

#include <algorithm>
#include <cmath>

#include "schema/pattern/filled_mesh.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::schema {
namespace {

bool is_at(const Json& point, const Eigen::Vector2d& place_mm) {
  constexpr double kSame_mm = 1e-9;
  return point.is_array() && point.size() >= 2 && point[0].is_number() && point[1].is_number() &&
         std::abs(point[0].get<double>() - place_mm.x()) <= kSame_mm &&
         std::abs(point[1].get<double>() - place_mm.y()) <= kSame_mm;
}

bool is_mesh_of(const Pattern& pattern, const Json& fold) {
  const auto fillers = read_fillers(fold, pattern);
  if (!fillers) return false;
  const Eigen::Matrix2Xd vertices_mm = pattern.vertices_mm();
  std::vector<Eigen::Vector2d> places_mm(vertices_mm.colwise().begin(),
                                         vertices_mm.colwise().end());
  for (const MeshFiller& mesh_filler : *fillers) {
    places_mm.push_back(solver::flat_apex_mm(mesh_filler.filler, vertices_mm));
  }
  const Json points = fold.value("vertices_coords", Json());
  if (!points.is_array() || points.size() != places_mm.size()) return false;
  for (std::size_t v = 0; v < places_mm.size(); ++v) {
    if (!is_at(points[v], places_mm[v])) return false;
  }
  Json mesh = perforated_mesh_json(pattern);
  add_fillers(pattern, *fillers, mesh);
  for (const auto& [key, value] : mesh.items()) {
    // Faces follow from the edges and may be left out.
    if (key == "faces_vertices" && !fold.contains(key)) continue;
    if (fold.value(key, Json()) != value) return false;
  }
  return true;
}

}  // namespace

Json perforated_mesh_json(const Pattern& pattern) {
  const solver::PerforatedSheet& base = pattern.base;
  const std::vector<int> kept = solver::kept_facets(base.sheet, base.holes);
  const auto is_kept = [&](int f) { return std::binary_search(kept.begin(), kept.end(), f); };
  Json edges = Json::array(), letters = Json::array(), faces = Json::array();
  for (std::size_t e = 0; e < base.sheet.edges.size(); ++e) {
    const solver::Edge& edge = base.sheet.edges[e];
    edges.push_back({edge.a, edge.b});
    if (is_kept(edge.left) && is_kept(edge.right)) {
      letters.push_back(base.folding.side() * base.folding.assignment()[e] > 0 ? "V" : "M");
    } else {
      letters.push_back("B");
    }
  }
  for (const int f : kept) faces.push_back(base.sheet.facets[f]);
  return {{"edges_vertices", edges}, {"edges_assignment", letters}, {"faces_vertices", faces}};
}

Pattern read_carried_pattern(const Json& fold, InputFaults& faults, Perforations perforations) {
  const std::size_t before = faults.count();
  Pattern pattern = read_pattern(fold.at(kCarriedPattern), kCarriedPattern, Displacements::allowed,
                                 {}, faults, perforations);
  if (faults.count() == before && !is_mesh_of(pattern, fold)) {
    faults.add(
        kCarriedPattern,
        "is not the pattern of this file's vertices, edges and faces, which were changed since",
        "export the candidate again; shifts are changed in its JSON export, displacements_mm");
  }
  return pattern;
}

}  // namespace misalign::schema
