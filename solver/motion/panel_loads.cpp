#include "solver/motion/panel_loads.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

#include "solver/kinematics/diagonals.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kOfPanel = PanelLoads::kOfPanel;

// Velocities and angular momenta of the panels along the way, from which accelerations follow.
SmoothTable momenta_on_the_way(const FoldingWay& way, SheetMover& mover) {
  const auto count = static_cast<Index>(way.stations().size());
  Eigen::MatrixXd values;
  for (Index k = 0; k < count; ++k) {
    const WayStation& station = way.stations()[static_cast<std::size_t>(k)];
    const MovingPanels sheet = mover.move(station.state, station.rates.data());
    if (k == 0) values.resize(kOfPanel * static_cast<Index>(sheet.panels.size()), count);
    Index row = 0;
    for (const MovingPanels::Panel& panel : sheet.panels) {
      values.block<3, 1>(row, k) = panel.velocity;
      values.block<3, 1>(row + 3, k) = panel.inertia * panel.spin;
      row += kOfPanel;
    }
  }
  // Parities are those of the mirror image, traversed in the other direction.
  using enum SmoothTable::Parity;
  std::vector<SmoothTable::Parity> parities;
  for (Index row = 0; row < values.rows(); row += kOfPanel) {
    parities.insert(parities.end(), {odd, odd, even, even, even, odd});
  }
  return way.table(values, std::move(parities));
}

}  // namespace

PanelLoads::PanelLoads(const EnergyModel& sheet, const FoldedShape& shape,
                       const PerforatedSheet& base, bool in_motion)
    : sheet_(sheet),
      way_(sheet.way()),
      in_motion_(in_motion),
      panels_(panels_of(base, mechanism())),
      held_(sheet.options().held ? std::optional(sheet.options().held->panel) : std::nullopt),
      mover_(shape, way_, panels_, sheet.options().plates, held_),
      momenta_(momenta_on_the_way(way_, mover_)),
      forces_(mechanism(), panels_) {}

void PanelLoads::pose(const Deployment::Row& at) {
  x_ = at.x;
  moved_ = {0, 0};
  if (in_motion_) {
    const EnergyAt energy = sheet_.at(at.x);
    assert(energy.mass > 0);
    const double friction = at.x_rate == 0 ? 0 : std::copysign(energy.friction, at.x_rate);
    const double force = -energy.mass_slope * at.x_rate * at.x_rate / 2 - energy.slope - friction -
                         energy.damping * at.x_rate;
    moved_ = {at.x_rate, force / energy.mass};
  }
  FoldState<double> state = way_.stations().front().state;
  VectorXd rates;
  way_.find_state(at.x, state);
  way_.find_rates(at.x, rates);
  moving_ = mover_.move(state, rates.data());
  hinges_.clear();
  for (const Crease& crease : mechanism().creases) {
    const int left = panel_of(crease.left);
    const Vector3d a = place_mm(left, crease.a), b = place_mm(left, crease.b);
    const Vector3d axis = (b - a).normalized(), normal = axis.unitOrthogonal();
    hinges_.push_back({(a + b) / 2, axis, normal, axis.cross(normal), (b - a).norm()});
  }
}

VectorXd PanelLoads::find(const std::optional<VectorXd>& filling_forces_n) {
  assert(hinges_.size() == mechanism().creases.size() && "the sheet is posed");
  VectorXd loads = VectorXd::Zero(kOfPanel * panels());
  add_filling(filling_forces_n, loads);
  add_joints(loads);
  add_weight(loads);
  if (in_motion_) add_inertia(loads);
  return loads;
}

void PanelLoads::add(int panel, const Vector3d& at_mm, const Vector3d& force_n,
                     const Vector3d& moment_n_mm, VectorXd& loads) const {
  const Index first = kOfPanel * panel;
  assert(panel >= 0 && panel < panels() && loads.size() == kOfPanel * panels());
  const Vector3d arm_mm = at_mm - moving_.panels[static_cast<std::size_t>(panel)].centre_mm;
  loads.segment<3>(first) += force_n;
  loads.segment<3>(first + 3) += arm_mm.cross(force_n) + moment_n_mm;
}

// m a = F and dH/dt = M, in the rotating frame of the first panel.
void PanelLoads::add_inertia(VectorXd& loads) const {
  assert(loads.size() == momenta_.functions());
  VectorXd momenta, slopes;
  momenta_.find(x_, 0, momenta_.functions(), momenta, slopes);
  const Vector3d frame_spin = moving_.frame_spin * moved_.rate;
  for (std::size_t k = 0; k < moving_.panels.size(); ++k) {
    const Index first = kOfPanel * static_cast<Index>(k);
    const auto rate_of = [&](Index at) -> Vector3d {
      const Vector3d momentum = momenta.segment<3>(at), slope = slopes.segment<3>(at);
      return slope * moved_.rate * moved_.rate + momentum * moved_.acceleration +
             frame_spin.cross(momentum * moved_.rate);
    };
    loads.segment<3>(first) -= moving_.panels[k].mass_t * rate_of(first);
    loads.segment<3>(first + 3) -= rate_of(first + 3);
  }
}

// Springs that end beside the vertices act on the panels that carry their ends.
void PanelLoads::add_filling(const std::optional<VectorXd>& forces_n, VectorXd& loads) const {
  VectorXd lengths_mm, rates;
  way_.find_lengths(x_, lengths_mm, rates);
  const bool at_vertices = mechanism().springs.at_vertices();
  const Eigen::Matrix3Xd vertices_mm = at_vertices ? this->vertices_mm() : Eigen::Matrix3Xd();
  const Filling& filling = sheet_.filling();
  for (Index h = 0; h < filling.holes(); ++h) {
    HoleEnergy hole = filling.hole(h, lengths_mm.segment<2>(2 * h));
    if (forces_n) hole.force_n = forces_n->segment<2>(2 * h);
    if (!at_vertices) {
      add_carried(h, hole, loads);
      continue;
    }
    for (const FillingForce& force : forces_.of_hole(filling, h, hole, vertices_mm)) {
      add(force.panel, (vertices_mm.col(force.from) + vertices_mm.col(force.to)) / 2, force.n,
          Vector3d::Zero(), loads);
    }
  }
}

void PanelLoads::add_carried(Index hole, const HoleEnergy& state, VectorXd& loads) const {
  for (int k = 0; k < 2; ++k) {
    const Diagonal& diagonal = mechanism().diagonals[static_cast<std::size_t>(2 * hole + k)];
    const Loop& loop = mechanism().loops[static_cast<std::size_t>(diagonal.loop)];
    const auto panel_at = [&](int corner) {
      return panel_of(loop.carriers[static_cast<std::size_t>(corner)].facet);
    };
    const auto end_mm = [&](int corner) {
      const Vec3<double> end = spring_end(mechanism(), way_.geometry(), loop, corner);
      return mover_.carried_mm(panel_at(corner),
                               mechanism().panel_width_mm * Vector3d(end.x, end.y, end.z));
    };
    const Vector3d from_mm = end_mm(diagonal.from_corner), to_mm = end_mm(diagonal.to_corner);
    const Vector3d pull_n = state.force_n(k) * (to_mm - from_mm).normalized();
    add(panel_at(diagonal.from_corner), from_mm, pull_n, Vector3d::Zero(), loads);
    add(panel_at(diagonal.to_corner), to_mm, -pull_n, Vector3d::Zero(), loads);
  }
}

Eigen::Matrix3Xd PanelLoads::vertices_mm() const {
  Eigen::Matrix3Xd vertices_mm = Eigen::Matrix3Xd::Zero(3, mechanism().vertices);
  for (std::size_t k = 0; k < panels_.corners.size(); ++k) {
    for (const int v : panels_.corners[k]) {
      vertices_mm.col(v) = place_mm(static_cast<int>(k), v);
    }
  }
  return vertices_mm;
}

// The right panel turns by -rho about a -> b: moments that resist rho push it on.
void PanelLoads::add_joints(VectorXd& loads) const {
  const VectorXd resisting = sheet_.crease_moments_n_mm(x_, moved_.rate);
  assert(resisting.size() == std::ssize(hinges_));
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    const Crease& crease = mechanism().creases[k];
    const double moment = resisting(static_cast<Index>(k));
    add(panel_of(crease.right), hinges_[k].middle_mm, Vector3d::Zero(), moment * hinges_[k].axis,
        loads);
    add(panel_of(crease.left), hinges_[k].middle_mm, Vector3d::Zero(), -moment * hinges_[k].axis,
        loads);
  }
  const double ball_n_mm = sheet_.options().joints.ball_friction_n_mm;
  if (ball_n_mm <= 0 || moved_.rate == 0) return;
  for (const BallJoint& ball : mechanism().balls) {
    const auto spin_of = [&](int facet) {
      return moving_.panels[static_cast<std::size_t>(panel_of(facet))].spin;
    };
    const Vector3d turning = moved_.rate * (spin_of(ball.to_facet) - spin_of(ball.from_facet));
    const Vector3d moment = -ball_n_mm * turning.normalized();
    loads.segment<3>(kOfPanel * panel_of(ball.to_facet) + 3) += moment;
    loads.segment<3>(kOfPanel * panel_of(ball.from_facet) + 3) -= moment;
  }
}

void PanelLoads::add_weight(VectorXd& loads) const {
  assert(loads.size() == kOfPanel * panels());
  if (!held_) return;
  Vector3d gravity = sheet_.options().held->gravity_mm_per_s2;
  gravity.z() *= mechanism().side;
  gravity = mover_.turn(*held_) * gravity;
  for (std::size_t k = 0; k < moving_.panels.size(); ++k) {
    loads.segment<3>(kOfPanel * static_cast<Index>(k)) += moving_.panels[k].mass_t * gravity;
  }
}

}  // namespace misalign::solver
