// Gives the forces of a hole's plate on the four edges that it is bonded to.
#pragma once

#include "solver/fill/hole_energy.hpp"

namespace misalign::solver {

/// Corners of a hole in their order, mm: the first diagonal leads from column 0 to 2, the second
/// from 1 to 3.
using HoleCorners = Eigen::Matrix<double, 3, 4>;

/// Resultants of the mean stress (sum of force x vector over the diagonals, over the area) at the
/// middles of the edges, N: column k is of the edge from corner k, on the panel beside it. Halves
/// of two neighbours' add up to the force at their corner that does the work of the plate's energy;
/// where the hole is not flat, edges count by their projections on the plane of the diagonals.
Eigen::Matrix<double, 3, 4> edge_forces_n(const HoleEnergy& plate, const HoleCorners& corners_mm);

}  // namespace misalign::solver
