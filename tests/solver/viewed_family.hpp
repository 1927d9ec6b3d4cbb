// Families of patterns seen otherwise: in another unit of length, elsewhere, from another side,
// under other numbers.
#pragma once

#include <algorithm>
#include <numeric>

#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/families.hpp"

namespace misalign::solver {

/// A sheet seen otherwise: x -> linear * x + offset_mm, vertex v called number[v].
struct View {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d offset_mm = Eigen::Vector2d::Zero();
  bool from_below = false;  ///< mountains are valleys
  std::vector<int> number;

  explicit View(const CarriedFamily& family) : number(family.base.sheet.vertex_count()) {
    std::iota(number.begin(), number.end(), 0);
  }
};

/// The base as it is read back in this view: its mesh goes through a FOLD object.
inline PerforatedSheet seen_base(const CarriedFamily& family, const View& view) {
  const PerforatedSheet& base = family.base;
  Json mesh = schema::fold_json(base.sheet, assignment_from_above(base.folding));
  const Json points = mesh["vertices_coords"], faces = mesh["faces_vertices"];
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Eigen::Vector2d seen =
        view.linear * Eigen::Vector2d(points[v][0], points[v][1]) + view.offset_mm;
    mesh["vertices_coords"][view.number[v]] = {seen.x(), seen.y()};
  }
  // The holes go as missing faces.
  mesh["faces_vertices"] = Json::array();
  for (int f = 0; f < base.sheet.facet_count(); ++f) {
    if (std::binary_search(base.holes.begin(), base.holes.end(), f)) continue;
    mesh["faces_vertices"].push_back(faces[f]);
  }
  for (const char* key : {"edges_vertices", "faces_vertices"}) {
    for (Json& vertices : mesh[key]) {
      for (Json& v : vertices) v = view.number[v.get<int>()];
    }
  }
  if (view.linear.determinant() < 0) {  // faces run counter-clockwise where letters are read
    for (Json& face : mesh["faces_vertices"]) std::reverse(face.begin(), face.end());
  }
  if (view.from_below) {
    for (Json& letter : mesh["edges_assignment"]) {
      if (letter != "B") letter = letter == "V" ? "M" : "V";
    }
  }
  const Edge& pilot = base.sheet.edges[base.folding.pilot_edge()];
  const Json pattern = {{"family", "fold"},
                        {"mesh", mesh},
                        {"pilot", line_label(view.number[pilot.a], view.number[pilot.b])}};
  schema::InputFaults faults;
  auto seen = schema::read_pattern(pattern, "", schema::Displacements::refused, ".", faults);
  faults.refuse("the mesh");
  return std::move(seen.base);
}

}  // namespace misalign::solver
