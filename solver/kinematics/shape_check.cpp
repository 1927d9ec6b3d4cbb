#include "solver/kinematics/shape_check.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

// Not a number counts as the worst.
void raise(double& worst, double value) {
  if (value > worst || std::isnan(value)) worst = value;
}

double folded_deg(const Eigen::Matrix3Xd& vertices_mm, const FoldLine& fold,
                  const std::vector<std::array<int, 4>>& panels) {
  const Vector3d along = (vertices_mm.col(fold.b) - vertices_mm.col(fold.a)).normalized();
  return fold_angle_deg(along, normal_of(vertices_mm, panels[fold.left]),
                        normal_of(vertices_mm, panels[fold.right]));
}

}  // namespace

Vector3d normal_of(const Eigen::Matrix3Xd& vertices_mm, const std::array<int, 4>& panel) {
  const Vector3d first = vertices_mm.col(panel[2]) - vertices_mm.col(panel[0]);
  const Vector3d second = vertices_mm.col(panel[3]) - vertices_mm.col(panel[1]);
  return first.cross(second).normalized();
}

double fold_angle_deg(const Vector3d& along, const Vector3d& left, const Vector3d& right) {
  return std::atan2(along.dot(right.cross(left)), left.dot(right)) * 180 / std::numbers::pi;
}

ShapeCheck::ShapeCheck(const Eigen::Matrix2Xd& flat_mm, std::vector<std::array<int, 4>> panels,
                       std::vector<FoldLine> folds)
    : flat_mm_(Eigen::Matrix3Xd::Zero(3, flat_mm.cols())),
      panels_(std::move(panels)),
      folds_(std::move(folds)),
      angles_deg_(folds_.size(), 0) {
  flat_mm_.topRows(2) = flat_mm;
}

void ShapeCheck::see(const Eigen::Matrix3Xd& vertices_mm, const Eigen::Matrix3Xd& corners_mm,
                     const std::vector<double>& claimed_deg) {
  assert(claimed_deg.size() == folds_.size());
  see_panels(vertices_mm, corners_mm);
  for (std::size_t i = 0; i < folds_.size(); ++i) {
    const double within = folded_deg(vertices_mm, folds_[i], panels_);
    const double angle = angles_deg_[i] + std::remainder(within - angles_deg_[i], 360);
    angles_deg_[i] = angle;
    raise(worst_.angle_deg, std::abs(angle - claimed_deg[i]));
    raise(worst_.beyond_deg, std::abs(angle) - 180);
    if (!(angle * folds_[i].sign > 0)) worst_.wrong_sign = static_cast<int>(i);
  }
}

void ShapeCheck::see_panels(const Eigen::Matrix3Xd& vertices_mm,
                            const Eigen::Matrix3Xd& corners_mm) {
  assert(vertices_mm.cols() == flat_mm_.cols());
  assert(corners_mm.cols() == 4 * std::ssize(panels_));
  Eigen::Index corner = 0;
  for (const std::array<int, 4>& panel : panels_) {
    for (int i = 0; i < 4; ++i) {
      for (int k = i + 1; k < 4; ++k) {
        const double flat = (flat_mm_.col(panel[i]) - flat_mm_.col(panel[k])).norm();
        const double folded = (vertices_mm.col(panel[i]) - vertices_mm.col(panel[k])).norm();
        raise(worst_.length_mm, std::abs(folded - flat));
      }
    }
    const Vector3d side = vertices_mm.col(panel[1]) - vertices_mm.col(panel[0]);
    raise(worst_.planarity_mm, std::abs(side.dot(normal_of(vertices_mm, panel))));
    for (const int vertex : panel) {
      raise(worst_.coincidence_mm, (corners_mm.col(corner++) - vertices_mm.col(vertex)).norm());
    }
  }
}

}  // namespace misalign::solver
