// Sheets that several tests fold.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "solver/linear/newton.hpp"
#include "solver/pattern/miura.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::solver {

using Json = nlohmann::json;

inline Json golden(const std::string& name) {
  return Json::parse(std::ifstream(std::string(MISALIGN_SOURCE_DIR "/tests/golden/") + name));
}

/// "5.5e-10", for a recorded property.
inline std::string scientific(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

/// A perforated Miura-ori in proportion to the paper's, panels `width_mm` wide.
struct TestSheet {
  TestSheet(int rows, int columns, const std::string& holes = "checkerboard-odd",
            double width_mm = 80)
      : width_mm_(width_mm) {
    const auto shape = MiuraShape::uniform(rows, columns, width_mm, width_mm, width_mm / 2);
    base.sheet = miura_sheet(shape);
    base.holes = checkerboard(base.sheet, holes == "checkerboard-odd" ? 1 : 0);
    base.folding = std::get<BaseFolding>(fold_sequentially(
        base.sheet, miura_assignment(shape, base.sheet), default_pilot(base.sheet, base.holes)));
    mechanism = build_mechanism(base);
    place(mechanism, base.sheet.vertices_mm, geometry);
  }

  PathPlan plan(const PathPlanOptions& options = {}) const {
    return plan_path(mechanism, base.folding, base.sheet.vertices_mm, options);
  }
  FoldState<double> folded(double pilot_deg) const {
    return base_state(mechanism, base.folding, base.sheet.vertices_mm,
                      half_angle_of_deg(pilot_deg));
  }
  /// The whole path of a sheet with these vertices.
  FoldingHistory history(const FlatVertices& vertices_mm,
                         const PathPlanOptions& options = {}) const {
    return record_history(Model(base, options), vertices_mm);
  }
  /// The base with {"A10": [x, y], ...} added, in proportion to the panels.
  FlatVertices shifted(const Json& displacements_mm) const {
    FlatVertices vertices = base.sheet.vertices_mm;
    for (const auto& [label, shift] : displacements_mm.items()) {
      const int vertex = std::stoi(label.substr(1)) - 1;
      vertices.col(vertex) +=
          Eigen::Vector2d(shift[0].get<double>(), shift[1].get<double>()) * (width_mm_ / 80);
    }
    return vertices;
  }

  PerforatedSheet base;
  Mechanism mechanism;
  SheetGeometry<double> geometry;

 private:
  double width_mm_;
};

}  // namespace misalign::solver
