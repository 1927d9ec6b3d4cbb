#include "solver/motion/energy_model.hpp"

#include <cassert>
#include <cmath>

#include "solver/motion/moving_mass.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd relaxed_angles(const FoldingWay& way, double rest_deg) {
  VectorXd angles_rad, rates;
  way.find_creases(way.x_of(rest_deg), angles_rad, rates);
  return angles_rad;
}

// Rows: the generalised mass, and the centre of mass. Its z changes sign on the other side of flat.
SmoothTable masses_on_the_way(const FoldingWay& way, const FoldedShape& shape,
                              const PerforatedSheet& base, const EnergyModel::Options& options) {
  const Panels panels = panels_of(base, way.mechanism());
  const std::optional<int> held = options.held ? std::optional(options.held->panel) : std::nullopt;
  assert(!held || (*held >= 0 && *held < std::ssize(panels.facets)));
  SheetMover mover(shape, way, panels, options.plates, held);
  Eigen::MatrixXd values(4, static_cast<Index>(way.stations().size()));
  Index k = 0;
  for (const WayStation& station : way.stations()) {
    const MovingPanels sheet = mover.move(station.state, station.rates.data());
    // The centre is seen from the held panel, from +z.
    Eigen::Vector3d centre_mm = mover.seen_from(held.value_or(0), sheet.centre_mm());
    centre_mm.z() *= way.mechanism().side;
    values.col(k++) << sheet.generalised_mass(), centre_mm;
  }
  using Parity = SmoothTable::Parity;
  return way.table(values, {Parity::even, Parity::even, Parity::even, Parity::odd});
}

double mass_of_all(const FoldingWay& way, const PerforatedSheet& base, const Plates& plates) {
  double mass_t = 0;
  const Panels panels = panels_of(base, way.mechanism());
  for (const PanelMass& mass : panel_masses(plates, panels.corners, way.from_a1_mm())) {
    mass_t += mass.mass_t;
  }
  assert(mass_t > 0);
  return mass_t;
}

}  // namespace

VectorXd crease_lengths_mm(const FoldingWay& way) {
  const std::vector<Crease>& creases = way.mechanism().creases;
  VectorXd lengths_mm(std::ssize(creases));
  for (Index k = 0; k < lengths_mm.size(); ++k) {
    const Crease& crease = creases[static_cast<std::size_t>(k)];
    lengths_mm(k) = (way.from_a1_mm().col(crease.b) - way.from_a1_mm().col(crease.a)).norm();
  }
  return lengths_mm;
}

EnergyModel::EnergyModel(const FoldingWay& way, const FoldedShape& shape,
                         const PerforatedSheet& base, const Options& options)
    : way_(way),
      options_(options),
      mass_t_(mass_of_all(way, base, options.plates)),
      filling_(filling_on(way, options.fill)),
      crease_mm_(crease_lengths_mm(way)),
      rest_rad_(relaxed_angles(way, options.joints.rest_deg)),
      masses_(masses_on_the_way(way, shape, base, options)) {}

EnergyModel::Potential EnergyModel::filled(double x) const {
  way_.find_lengths(x, lengths_, length_rates_);
  Potential sum{0, 0};
  for (Index h = 0; h < filling_.holes(); ++h) {
    const HoleEnergy hole = filling_.hole(h, lengths_.segment<2>(2 * h));
    sum.energy += hole.n_mm;
    sum.slope += hole.force_n.dot(length_rates_.segment<2>(2 * h));
  }
  return sum;
}

EnergyModel::Potential EnergyModel::all_else(double x) const {
  Potential sum{0, 0};
  const JointResistance& joints = options_.joints;
  if (joints.stiffness_n_mm_per_mm > 0) {
    way_.find_creases(x, angles_, angle_rates_);
    angles_ -= rest_rad_;
    const auto moments = (joints.stiffness_n_mm_per_mm * crease_mm_.array() * angles_.array());
    sum = {moments.matrix().dot(angles_) / 2, moments.matrix().dot(angle_rates_)};
  }
  if (options_.held) {
    masses_.find(x, 1, 3, mass_, mass_rate_);
    const Eigen::Vector3d weight_n = mass_t_ * options_.held->gravity_mm_per_s2;
    sum.energy -= weight_n.dot(mass_);
    sum.slope -= weight_n.dot(mass_rate_);
  }
  return sum;
}

VectorXd EnergyModel::filling_forces_n(double x) const {
  way_.find_lengths(x, lengths_, length_rates_);
  return filling_.forces_n(lengths_);
}

bool EnergyModel::is_filling_relaxed(double x, double within_mm) const {
  if (filling_.diagonals() == 0) return true;
  const VectorXd forces_n = filling_forces_n(x);
  return forces_n.norm() <= within_mm * filling_.stiffness_n_per_mm(lengths_).cwiseAbs().maxCoeff();
}

VectorXd EnergyModel::crease_moments_n_mm(double x, double x_rate) const {
  way_.find_creases(x, angles_, angle_rates_);
  const JointResistance& joints = options_.joints;
  const Eigen::ArrayXd rates = x_rate * angle_rates_.array();
  return crease_mm_.array() *
         (joints.friction_n_mm_per_mm * rates.sign() + joints.damping_n_mm_s_per_mm * rates +
          joints.stiffness_n_mm_per_mm * (angles_ - rest_rad_).array());
}

EnergyModel::Turning EnergyModel::turning(double x) const {
  way_.find_creases(x, angles_, angle_rates_);
  way_.find_balls(x, speeds_);
  return {crease_mm_.dot(angle_rates_.cwiseAbs()), speeds_.sum()};
}

EnergyAt EnergyModel::at(double x) const {
  assert(options_.joints.stiffness_n_mm_per_mm >= 0);
  EnergyAt energy{};
  masses_.find(x, 0, 1, mass_, mass_rate_);
  energy.mass = mass_(0);
  energy.mass_slope = mass_rate_(0);
  const Potential filled = this->filled(x), rest = all_else(x);
  energy.filling_n_mm = filled.energy;
  energy.potential = filled.energy + rest.energy;
  energy.slope = filled.slope + rest.slope;
  assert(energy.filling_n_mm >= 0 && std::isfinite(energy.potential));
  const JointResistance& joints = options_.joints;
  if (!joints.slows_down()) return energy;
  const Turning turning = this->turning(x);  // sets angle_rates_
  energy.friction =
      joints.friction_n_mm_per_mm * turning.creases_mm + joints.ball_friction_n_mm * turning.balls;
  energy.damping =
      joints.damping_n_mm_s_per_mm * crease_mm_.dot(angle_rates_.cwiseProduct(angle_rates_));
  assert(energy.friction >= 0 && energy.damping >= 0);
  return energy;
}

}  // namespace misalign::solver
