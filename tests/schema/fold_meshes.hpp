// FOLD meshes that several tests write.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "schema/pattern/fold_format.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/pattern/miura.hpp"

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

}  // namespace misalign::schema
