// A panel as a solid: its trimmed outline with the plate's thickness, tapered towards its creases.
#pragma once

#include "solver/contact/plate_thickness.hpp"

namespace misalign::solver {

/// A convex solid: faces as corners in turn, counter-clockwise seen from outside.
struct PlateSolid {
  std::vector<Eigen::Vector3d> vertices_mm;
  std::vector<std::vector<int>> faces;
};

/// All plates on the flat sheet (A1 at the origin, mid-planes at z = 0), in the panels' order, with
/// the rules of plate_thickness.hpp. A plate that is thicker than its tapers allow loses the rest.
std::vector<PlateSolid> plate_solids(const Panels& panels, const FlatVertices& vertices_mm,
                                     double thickness_mm, double trim_mm,
                                     const std::vector<double>& largest_rad);

}  // namespace misalign::solver
