// Miura-ori sheets with few holes, and members of their parallel families.
#pragma once

#include <random>

#include "solver/pattern/parallel_family.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {

/// With these of the inner panels taken out, of the paper's sheet if none other is given.
inline PerforatedSheet with_holes(const std::vector<std::size_t>& which,
                                  const MiuraShape& shape = MiuraShape::uniform(6, 6, 80, 80, 40)) {
  PerforatedSheet base;
  base.sheet = miura_sheet(shape);
  const std::vector<int> inner = inner_facets(base.sheet);
  for (const std::size_t k : which) base.holes.push_back(inner[k]);
  base.folding = std::get<BaseFolding>(fold_sequentially(
      base.sheet, miura_assignment(shape, base.sheet), default_pilot(base.sheet, base.holes)));
  return base;
}

inline ParallelFamily family_with_rim(const PerforatedSheet& base) {
  return std::get<ParallelFamily>(ParallelFamily::of(base, all_vertices(base.sheet)));
}

/// Coordinates of holes of like signs, or as they come; no vertex shifted by more than `most_mm`.
inline Eigen::Matrix2Xd member_of(const PerforatedSheet& base, double most_mm, bool like_signs,
                                  unsigned seed) {
  const ParallelFamily family = family_with_rim(base);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd coordinates(family.dimension());
  for (double& value : coordinates) value = uniform(random);
  for (int k = 0; like_signs && k < family.dimension(); ++k) {
    if (family.coordinates()[static_cast<std::size_t>(k)].kind != ParallelCoordinate::Kind::shape) {
      coordinates(k) = std::abs(coordinates(k));
    }
  }
  const Eigen::Matrix2Xd shifts_mm = family.shifts_mm(coordinates);
  return shifts_mm * (most_mm / shifts_mm.cwiseAbs().maxCoeff());
}

}  // namespace misalign::solver
