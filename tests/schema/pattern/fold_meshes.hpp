// FOLD meshes that several tests write.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/pattern/miura.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::schema {

inline Json miura_mesh(int rows, int columns) {
  const auto shape = solver::MiuraShape::uniform(rows, columns, 80, 80, 40);
  const auto sheet = solver::miura_sheet(shape);
  return fold_json(sheet, solver::miura_assignment(shape, sheet));
}

inline Json pattern_of(const Json& mesh) { return {{"family", "fold"}, {"mesh", mesh}}; }

inline std::size_t edge_index(const Json& mesh, int a, int b) {
  const Json& edges = mesh["edges_vertices"];
  return static_cast<std::size_t>(std::find(edges.begin(), edges.end(), Json{a, b}) -
                                  edges.begin());
}

inline Pattern good(const Json& pattern) {
  InputFaults faults;
  Pattern read = read_pattern(pattern, "", Displacements::allowed, ".", faults);
  EXPECT_TRUE(faults.none()) << faults.sentences().front();
  return read;
}

inline solver::FoldingHistory history_of(const Pattern& pattern) {
  return solver::record_history(solver::Model(pattern.base), pattern.vertices_mm());
}

}  // namespace misalign::schema
