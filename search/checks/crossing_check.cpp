#include "search/checks/crossing_check.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace misalign::search {
namespace {

using Eigen::Vector3d;
using Corners = Eigen::Matrix<double, 3, 4>;
using Model = fcl::BVHModel<fcl::OBBd>;

// Returns the frame with the first corner as origin, the first edge as x and the normal as z.
fcl::Transform3d frame_of(const Corners& corners) {
  const Vector3d x = (corners.col(1) - corners.col(0)).normalized();
  const Vector3d z = x.cross(corners.col(3) - corners.col(0)).normalized();
  fcl::Transform3d frame = fcl::Transform3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = corners.col(0);
  return frame;
}

// Returns the shrunk panel as two triangles in its frame.
std::shared_ptr<Model> shrunk_panel(const Corners& flat_mm) {
  const Vector3d centre = flat_mm.rowwise().mean();
  const Corners shrunk = ((1 - kTouch) * (flat_mm.colwise() - centre)).colwise() + centre;
  const Corners local = frame_of(flat_mm).inverse() * shrunk;
  auto model = std::make_shared<Model>();
  model->beginModel(2, 4);
  model->addTriangle(local.col(0), local.col(1), local.col(2));
  model->addTriangle(local.col(0), local.col(2), local.col(3));
  model->endModel();
  return model;
}

}  // namespace

struct CrossingCheck::Scene {
  struct Panel {
    std::array<int, 4> vertices;
    double touch_mm;
    Corners corners_mm;
    fcl::CollisionObjectd object;
    int index;
  };
  std::vector<std::unique_ptr<Panel>> panels;  // at fixed addresses, which the broad phase stores
  fcl::DynamicAABBTreeCollisionManagerd manager;
  std::optional<std::pair<int, int>> found;

  static bool adjacent(const Panel& a, const Panel& b) {
    return std::find_first_of(a.vertices.begin(), a.vertices.end(), b.vertices.begin(),
                              b.vertices.end()) != a.vertices.end();
  }

  // Returns whether the panel has corners on both sides of the other's plane.
  static bool reaches_through(const Panel& panel, const Panel& other) {
    const fcl::Transform3d& frame = other.object.getTransform();
    const Eigen::RowVector4d heights =
        frame.linear().col(2).transpose() * (panel.corners_mm.colwise() - frame.translation());
    return heights.minCoeff() < -other.touch_mm && heights.maxCoeff() > other.touch_mm;
  }

  // Tests a pair whose boxes overlap; returns true to end the search.
  static bool look(fcl::CollisionObjectd* first, fcl::CollisionObjectd* second, void* scene) {
    const Panel& a = *static_cast<const Panel*>(first->getUserData());
    const Panel& b = *static_cast<const Panel*>(second->getUserData());
    if (adjacent(a, b) || !reaches_through(a, b) || !reaches_through(b, a)) return false;
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(first, second, request, result);
    if (!result.isCollision()) return false;
    static_cast<Scene*>(scene)->found = std::minmax(a.index, b.index);
    return true;
  }
};

CrossingCheck::CrossingCheck(const Eigen::Matrix2Xd& flat_mm,
                             const std::vector<std::array<int, 4>>& panels)
    : scene_(std::make_unique<Scene>()) {
  for (const std::array<int, 4>& vertices : panels) {
    Corners corners = Corners::Zero();
    for (int k = 0; k < 4; ++k) corners.col(k).head<2>() = flat_mm.col(vertices[k]);
    const double size_mm = (corners.col(2) - corners.col(0)).norm();
    auto panel = std::make_unique<Scene::Panel>(
        Scene::Panel{vertices, kTouch * size_mm, corners,
                     fcl::CollisionObjectd(shrunk_panel(corners), frame_of(corners)),
                     static_cast<int>(scene_->panels.size())});
    panel->object.setUserData(panel.get());
    scene_->manager.registerObject(&panel->object);
    scene_->panels.push_back(std::move(panel));
  }
  scene_->manager.setup();
}

CrossingCheck::~CrossingCheck() = default;

std::optional<std::pair<int, int>> CrossingCheck::crossing(const Eigen::Matrix3Xd& corners_mm) {
  for (const auto& panel : scene_->panels) {
    panel->corners_mm = corners_mm.middleCols<4>(4 * panel->index);
    panel->object.setTransform(frame_of(panel->corners_mm));
    panel->object.computeAABB();
  }
  scene_->manager.update();
  scene_->found.reset();
  scene_->manager.collide(scene_.get(), Scene::look);
  return scene_->found;
}

}  // namespace misalign::search
