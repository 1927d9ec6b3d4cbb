// The joints of a sheet as a tree of panels, and the points that close its loops: how programs for
// bodies in motion want a linkage.
#pragma once

#include <vector>

#include "solver/model/panels.hpp"

namespace misalign::solver {

struct JointTree {
  /// A joint that hangs one panel on another.
  struct Branch {
    bool ball;
    int joint;  ///< index into the mechanism's creases or ball joints
    int parent, child;
  };
  /// A vertex that two panels share because a joint, which is none of the branches, ties them.
  struct Closure {
    int vertex;
    int one, other;  ///< panels
  };

  int root;
  std::vector<Branch> branches;  ///< parents before children
  /// Of each ball joint that is left its vertex, of each crease that is left both ends; but for
  /// ends that others keep together already, as round a whole vertex. Of a crease's six equations
  /// one is still too many: both panels keep the distance of its ends.
  std::vector<Closure> closures;

  /// Whether a crease is a branch: the only hinges on which `frictionloss` can act in MuJoCo.
  std::vector<bool> crease_is_branch;
};

/// Breadth first from the panel on the left of the pilot, which is a branch itself. Ball joints are
/// taken only where no crease leads on: as many creases as can be are branches.
JointTree joint_tree(const Mechanism& mechanism, const Panels& panels);

}  // namespace misalign::solver
