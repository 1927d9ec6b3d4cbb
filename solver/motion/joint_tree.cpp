#include "solver/motion/joint_tree.hpp"

#include <algorithm>
#include <cassert>

#include "solver/pattern/disjoint_sets.hpp"

namespace misalign::solver {
namespace {

struct Joint {
  bool ball;
  int joint;
  int first, second;  // panels
};

// The pilot, the other creases, and ball joints.
std::vector<Joint> joints_of(const Mechanism& mechanism, const Panels& panels) {
  assert(panels.folds.size() == mechanism.creases.size());
  std::vector<Joint> joints;
  for (int i = 0; i < static_cast<int>(panels.folds.size()); ++i) {
    joints.push_back({false, i, panels.folds[i].left, panels.folds[i].right});
  }
  std::swap(joints[0], joints[mechanism.pilot]);
  for (int i = 0; i < static_cast<int>(mechanism.balls.size()); ++i) {
    const BallJoint& ball = mechanism.balls[i];
    joints.push_back({true, i, panels.panel_of(ball.from_facet), panels.panel_of(ball.to_facet)});
  }
  return joints;
}

class Growth {
 public:
  Growth(const std::vector<Joint>& joints, int root, std::size_t panels)
      : joints_(joints), reached_(panels, false) {
    tree_.root = root;
    reached_[root] = true;
    frontier_.push_back(root);
  }

  JointTree grow() {
    std::size_t next = 0;
    do {
      for (; next < frontier_.size(); ++next) {
        for (const Joint& joint : joints_) {
          if (!joint.ball) hang(joint, frontier_[next]);
        }
      }
    } while (hang_by_a_ball());
    assert(tree_.branches.size() + 1 == reached_.size() && "joints hold all panels together");
    return tree_;
  }

 private:
  bool hang(const Joint& joint, int parent) {
    if (joint.first != parent && joint.second != parent) return false;
    const int child = joint.first == parent ? joint.second : joint.first;
    if (reached_[child]) return false;
    reached_[child] = true;
    frontier_.push_back(child);
    tree_.branches.push_back({joint.ball, joint.joint, parent, child});
    return true;
  }
  bool hang_by_a_ball() {
    for (const int parent : frontier_) {
      for (const Joint& joint : joints_) {
        if (joint.ball && hang(joint, parent)) return true;
      }
    }
    return false;
  }

  const std::vector<Joint>& joints_;
  std::vector<bool> reached_;
  std::vector<int> frontier_;
  JointTree tree_;
};

// The vertices that a joint keeps in place.
std::vector<int> vertices_of(const Mechanism& mechanism, const Joint& joint) {
  if (joint.ball) return {mechanism.balls[joint.joint].vertex};
  return {mechanism.creases[joint.joint].a, mechanism.creases[joint.joint].b};
}

}  // namespace

JointTree joint_tree(const Mechanism& mechanism, const Panels& panels) {
  const std::vector<Joint> joints = joints_of(mechanism, panels);
  JointTree tree = Growth(joints, joints.front().first, panels.facets.size()).grow();
  tree.crease_is_branch.assign(mechanism.creases.size(), false);
  std::vector<bool> ball_is_branch(mechanism.balls.size(), false);
  for (const JointTree::Branch& branch : tree.branches) {
    (branch.ball ? ball_is_branch : tree.crease_is_branch)[branch.joint] = true;
  }
  // Sets of panels that joints tie together at a vertex.
  std::vector<DisjointSets> at_vertex(mechanism.vertices, DisjointSets(panels.facets.size()));
  for (const bool branches : {true, false}) {
    for (const Joint& joint : joints) {
      if ((joint.ball ? ball_is_branch : tree.crease_is_branch)[joint.joint] != branches) continue;
      for (const int vertex : vertices_of(mechanism, joint)) {
        const bool is_new = at_vertex[vertex].tie(joint.first, joint.second);
        if (is_new && !branches) tree.closures.push_back({vertex, joint.first, joint.second});
      }
    }
  }
  return tree;
}

}  // namespace misalign::solver
