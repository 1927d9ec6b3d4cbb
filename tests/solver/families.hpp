// The families of base patterns that the program carries (search/patterns), at their own size and
// cut down, with draws in proportion to their panels.
#pragma once

#include <algorithm>

#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/reference/arc_length.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {

/// Names of the pattern files.
inline const std::vector<std::string>& carried_families() {
  static const std::vector<std::string> names = {
      "table1",  // the paper's Miura-ori; its displacements are not looked at
      "miura-wide-6x6",  "miura-narrow-6x6", "miura-graded-6x6", "double-corrugation-6x6",
      "angle-array-6x6", "turned-quads-6x6"};
  return names;
}

/// A name as a test's.
inline std::string family_word(const testing::TestParamInfo<std::string>& name) {
  std::string word = name.param;
  std::erase(word, '-');
  return word;
}

/// What a verdict says of the sheet, not of the path past it.
inline std::string decision(const Verdict& verdict) {
  return "D " + std::to_string(verdict.deploys_from_sample) + ", " +
         fault_name(verdict.first_fault) + " at " + std::to_string(verdict.where);
}

/// A base, and draws of it.
struct CarriedFamily {
  explicit CarriedFamily(PerforatedSheet sheet)
      : base(std::move(sheet)),
        mechanism(build_mechanism(base)),
        shifted_vertices(interior_vertices(base.sheet)) {}
  explicit CarriedFamily(const std::string& name)
      : CarriedFamily(
            schema::read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/" + name + ".json")
                .base) {}

  /// Whole degrees that the base folds.
  double end_deg() const { return std::floor(base.folding.end_deg()); }

  PathPlan plan(const PathPlanOptions& options) const {
    return plan_path(mechanism, base.folding, base.sheet.vertices_mm, options);
  }

  Model with(const PathPlanOptions& options) const {
    return Model(base, shifted_vertices, options, 1);
  }
  /// Shifts of 0.4 mm on panels of 80 mm.
  ShiftBlock draws(int sheets, unsigned seed) const {
    return ternary_draws(shifted_vertices.size(), sheets, seed, 0.005 * base.sheet.panel_width_mm);
  }
  FlatVertices vertices(const ShiftBlock& block, int i) const {
    return displaced(base.sheet.vertices_mm, shifted_vertices, block, i);
  }

  const PerforatedSheet base;
  const Mechanism mechanism;
  const std::vector<int> shifted_vertices;
};

/// Mountains and valleys of a base as seen from +z.
inline std::vector<int> assignment_from_above(const BaseFolding& folding) {
  std::vector<int> assignment = folding.assignment();
  for (int& sign : assignment) sign *= folding.side();
  return assignment;
}

/// The first rows and columns of a base, perforated as a checkerboard.
inline PerforatedSheet cut_down(const PerforatedSheet& whole, int rows, int columns) {
  const CreasePattern& sheet = whole.sheet;
  PerforatedSheet part;
  std::vector<int> number_of(sheet.vertex_count(), -1), vertices;
  for (int f = 0; f < sheet.facet_count(); ++f) {
    if (sheet.places[f][0] >= rows || sheet.places[f][1] >= columns) continue;
    part.sheet.facets.push_back(sheet.facets[f]);
    part.sheet.places.push_back(sheet.places[f]);
    for (const int v : sheet.facets[f]) number_of[v] = 0;
  }
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    if (number_of[v] < 0) continue;
    number_of[v] = static_cast<int>(vertices.size());
    vertices.push_back(v);
  }
  for (auto& facet : part.sheet.facets) {
    for (int& v : facet) v = number_of[v];
  }
  part.sheet.vertices_mm = sheet.vertices_mm(Eigen::all, vertices);
  part.sheet.panel_width_mm = sheet.panel_width_mm;
  part.sheet.edges = edges_of(part.sheet.facets);
  part.holes = checkerboard(part.sheet, 1);
  std::vector<int> assignment;
  for (const Edge& edge : part.sheet.edges) {
    const int of_whole = find_edge(sheet, vertices[edge.a], vertices[edge.b]);
    assignment.push_back(edge.on_perimeter() ? 0 : assignment_from_above(whole.folding)[of_whole]);
  }
  part.folding = std::get<BaseFolding>(
      fold_sequentially(part.sheet, assignment, default_pilot(part.sheet, part.holes)));
  return part;
}

}  // namespace misalign::solver
