// Gives the forces of a filling on the panels, where its diagonals end on the vertices.
#pragma once

#include <vector>

#include "solver/fill/filling.hpp"
#include "solver/model/panels.hpp"

namespace misalign::solver {

/// A force on a panel: at a vertex, or from one vertex to the next, at the middle of the edge.
struct FillingForce {
  int panel, from, to;
  Eigen::Vector3d n;
};

class FillingForces {
 public:
  /// Both must outlive this object.
  FillingForces(const Mechanism& mechanism, const Panels& panels);

  /// Forces of one hole's filling in this state, with the vertices at these places. Those of a
  /// spring act in equal parts on all panels at its ends, those of a plate on the panels that it is
  /// bonded to.
  std::vector<FillingForce> of_hole(const Filling& filling, Eigen::Index hole,
                                    const HoleEnergy& state,
                                    const Eigen::Matrix3Xd& vertices_mm) const;

 private:
  const Mechanism& mechanism_;
  const Panels& panels_;
  std::vector<std::vector<int>> panels_at_;  // index: vertex
};

}  // namespace misalign::solver
