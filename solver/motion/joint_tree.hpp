// The joints of a sheet as a tree of panels, and the points that close its loops: the linkage of
// multibody programs.
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
  /// A vertex that two panels share by a joint that is no branch.
  struct Closure {
    int vertex;
    int one, other;  ///< panels
  };

  int root;
  std::vector<Branch> branches;  ///< parents before children
  /// The vertex of each remaining ball joint, and both ends of each remaining crease, except ends
  /// that others already tie, as round a whole vertex. One of a crease's six equations is
  /// redundant: both panels keep the distance of its ends.
  std::vector<Closure> closures;

  /// True of creases that are branches: the only hinges on which `frictionloss` can act in MuJoCo.
  std::vector<bool> crease_is_branch;
};

/// Breadth first from the panel on the left of the pilot, which is a branch itself. Ball joints are
/// branches only where no crease leads on, so that most creases are branches.
JointTree joint_tree(const Mechanism& mechanism, const Panels& panels);

}  // namespace misalign::solver
