#include "solver/motion/moving_mass.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

Matrix3d matrix(const Mat3<double>& m) {
  Matrix3d columns;
  columns << vector(m.cx), vector(m.cy), vector(m.cz);
  return columns;
}

// Inertia of a point mass at this arm.
Matrix3d inertia_of(double mass_t, const Vector3d& arm_mm) {
  return mass_t * (arm_mm.squaredNorm() * Matrix3d::Identity() - arm_mm * arm_mm.transpose());
}

// The rigid motion that has the panels' momentum and angular momentum: spin, and the velocity of
// the common centre.
struct RigidMotion {
  Vector3d spin, velocity, centre_mm;
};

RigidMotion rigid_motion(const MovingPanels& sheet) {
  double mass_t = 0;
  Vector3d momentum = Vector3d::Zero(), angular = momentum;
  for (const MovingPanels::Panel& panel : sheet.panels) {
    mass_t += panel.mass_t;
    momentum += panel.mass_t * panel.velocity;
  }
  const Vector3d centre = sheet.centre_mm();
  assert(mass_t > 0);
  Matrix3d inertia = Matrix3d::Zero();
  for (const MovingPanels::Panel& panel : sheet.panels) {
    const Vector3d arm = panel.centre_mm - centre;
    angular += panel.mass_t * arm.cross(panel.velocity) + panel.inertia * panel.spin;
    inertia += panel.inertia + inertia_of(panel.mass_t, arm);
  }
  return {inertia.ldlt().solve(angular), momentum / mass_t, centre};
}

void subtract(const RigidMotion& motion, MovingPanels& sheet) {
  for (MovingPanels::Panel& panel : sheet.panels) {
    panel.velocity -= motion.velocity + motion.spin.cross(panel.centre_mm - motion.centre_mm);
    panel.spin -= motion.spin;
  }
  sheet.frame_spin -= motion.spin;
}

}  // namespace

double MovingPanels::generalised_mass() const {
  double twice_energy = 0;
  for (const Panel& panel : panels) {
    twice_energy +=
        panel.mass_t * panel.velocity.squaredNorm() + panel.spin.dot(panel.inertia * panel.spin);
  }
  return twice_energy;
}

Vector3d MovingPanels::centre_mm() const {
  double mass_t = 0;
  Vector3d moment = Vector3d::Zero();
  for (const Panel& panel : panels) {
    mass_t += panel.mass_t;
    moment += panel.mass_t * panel.centre_mm;
  }
  assert(mass_t > 0);
  return moment / mass_t;
}

MovingPanels SheetMover::move(const FoldState<double>& state, const double* rates) {
  const double width_mm = way_.mechanism().panel_width_mm;
  assert(!held_ || (*held_ >= 0 && *held_ < std::ssize(masses_)));
  shape_.place(way_.geometry(), state, points_);
  shape_.move(way_.geometry(), points_, rates, twists_);
  MovingPanels sheet{{}, Vector3d::Zero()};
  for (int k = 0; k < static_cast<int>(masses_.size()); ++k) {
    const auto index = static_cast<std::size_t>(k);
    const Matrix3d turned = turn(k);
    const Matrix3d spread =
        turned.leftCols<2>() * masses_[index].spread * turned.leftCols<2>().transpose();
    const FoldedShape::Twist<double>& twist =
        twists_[static_cast<std::size_t>(panels_.facets[index])];
    const Vector3d spin = vector(twist.spin), centre = place_mm(k, masses_[index].centre_mm);
    sheet.panels.push_back({masses_[index].mass_t, centre,
                            spin.cross(centre) + width_mm * vector(twist.drift), spin,
                            spread.trace() * Matrix3d::Identity() - spread});
  }
  if (held_) {
    const MovingPanels::Panel& held = sheet.panels[static_cast<std::size_t>(*held_)];
    subtract({held.spin, held.velocity, held.centre_mm}, sheet);
  } else {
    subtract(rigid_motion(sheet), sheet);
  }
  return sheet;
}

Matrix3d SheetMover::turn(int panel) const { return matrix(pose(panel).rotation); }

Vector3d SheetMover::shift_mm(int panel) const {
  return way_.mechanism().panel_width_mm * vector(pose(panel).translation);
}

}  // namespace misalign::solver
