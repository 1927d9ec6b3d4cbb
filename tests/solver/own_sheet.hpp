// A sheet with a model and a solver of its own.
#pragma once

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct OwnSheet {
  OwnSheet(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
           const PathPlanOptions& path = {})
      : model(base, path), solver(model), sheet(solver, shifts_mm) {}

  const Model model;
  SheetSolver solver;
  const Sheet sheet;
};

/// Of the sheet with these vertices.
inline std::optional<FoldingWay> way_of(const Model& model, const FlatVertices& vertices_mm,
                                        int stations = kWayStations) {
  SheetSolver solver(model);
  const Sheet sheet(solver, vertices_mm - model.base().sheet.vertices_mm);
  const FoldingWay* const way = sheet.way(stations);
  return way ? std::optional(*way) : std::nullopt;
}

}  // namespace misalign::solver
