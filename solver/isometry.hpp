// The folded sheet as vertex coordinates, and a check that needs no equation of loop closure: rigid
// panels keep the lengths of their edges and diagonals.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/mechanism.hpp"

namespace misalign::solver {

/// Places each vertex by one facet only, reached over a spanning tree of joints, so that an error
/// of closure shows as a changed length in the facets that did not place all of their corners.
class FoldedShape {
 public:
  FoldedShape(const CreasePattern& sheet, const std::vector<int>& holes,
              const Mechanism& mechanism);

  /// 3 x N vertex coordinates in mm, the first kept facet lying in the plane z = 0.
  Eigen::Matrix3Xd vertices_mm(const SheetGeometry<double>& geometry,
                               const FoldState<double>& state) const;

  /// Largest change of any edge or diagonal of a kept facet between flat and folded, mm.
  double isometry_error_mm(const FlatVertices& flat_mm, const Eigen::Matrix3Xd& folded_mm) const;

 private:
  struct Branch {
    Passage joint;
    int parent, facet;
  };
  const Mechanism& mechanism_;
  std::vector<std::array<int, 4>> facets_;
  std::vector<bool> kept_;
  int root_ = 0;
  std::vector<Branch> tree_;    // parents before children
  std::vector<int> placed_by_;  // facet per vertex
};

}  // namespace misalign::solver
