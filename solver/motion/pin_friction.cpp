#include "solver/motion/pin_friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Number of intervals between angles in geometric progression; loads between them follow a power of
// the angle.
constexpr int kPinRows = 48;

struct Load {
  double in_middle = 0, at_ends = 0;
};

// Loads across the pins of a hinge, N.
Load load_of_hinge(const Vector3d& force_n, const Vector3d& moment_n_mm, const Vector3d& axis,
                   double length_mm) {
  assert(length_mm > 0 && std::abs(axis.norm() - 1) < 1e-6);
  const Vector3d across_n = force_n - force_n.dot(axis) * axis,
                 couple_n = moment_n_mm.cross(axis) / length_mm;
  return {across_n.norm(), (across_n / 2 + couple_n).norm() + (across_n / 2 - couple_n).norm()};
}

// Loads at these angles, in a sheet that is held.
PinStudy loads_at(const EnergyModel& sheet, const Model& model,
                  const std::vector<double>& pilot_deg) {
  const FoldingWay& way = sheet.way();
  const Mechanism& mechanism = model.mechanism();
  Deployment held{};
  for (const double angle_deg : pilot_deg) {
    Deployment::Row row{};
    row.x = way.x_of(angle_deg);
    row.pilot_deg = angle_deg;
    held.rows.push_back(row);
  }
  const JointForces forces = find_joint_forces(sheet, model.shape(), model.base(), held,
                                               {.in_motion = false, .from_deg = 0});
  PinStudy study{};
  assert(forces.pilot_deg.size() == pilot_deg.size());
  VectorXd angles_rad, rates, ball_rates;
  for (std::size_t k = 0; k < pilot_deg.size(); ++k) {
    const double x = held.rows[k].x, pilot_rate = way.pilot_rate(x);
    const auto vector = [&](const Eigen::MatrixXd& matrix, Index joint) -> Vector3d {
      return matrix.block<1, 3>(static_cast<Index>(k), 3 * joint).transpose();
    };
    way.find_creases(x, angles_rad, rates);
    way.find_balls(x, ball_rates);
    Load loss;
    for (Index c = 0; c < rates.size(); ++c) {
      const Crease& crease = mechanism.creases[static_cast<std::size_t>(c)];
      const double length_mm =
          (way.from_a1_mm().col(crease.b) - way.from_a1_mm().col(crease.a)).norm();
      const Load load =
          load_of_hinge(vector(forces.crease_force_n, c), vector(forces.crease_moment_n_mm, c),
                        vector(forces.crease_axis, c), length_mm);
      loss.in_middle += std::abs(rates(c)) * load.in_middle;
      loss.at_ends += std::abs(rates(c)) * load.at_ends;
    }
    for (Index b = 0; b < ball_rates.size(); ++b) {
      const double load_n = vector(forces.ball_force_n, b).norm();
      loss.in_middle += ball_rates(b) * load_n;
      loss.at_ends += ball_rates(b) * load_n;
    }
    const double driving = sheet.at(x).slope / pilot_rate;
    study.in_middle.rows.push_back({pilot_deg[k], driving, loss.in_middle / pilot_rate});
    study.at_ends.rows.push_back({pilot_deg[k], driving, loss.at_ends / pilot_rate});
  }
  return study;
}

// Integral between two rows of a power of the angle.
double integral(double a_deg, double a, double b_deg, double b) {
  assert(a_deg > b_deg && b_deg > 0);
  if (!(a > 0) || !(b > 0)) return 0.5 * (a + b) * (a_deg - b_deg) * kRadPerDeg;
  const double power = std::log(a / b) / std::log(a_deg / b_deg);
  return (a * a_deg - b * b_deg) * kRadPerDeg / (power + 1);
}

// Finds the least energy released since the start over the loss by 1 mm of mu r.
void find_critical(const EnergyModel& sheet, PinFriction& friction) {
  const FoldingWay& way = sheet.way();
  const std::vector<PinFriction::Row>& rows = friction.rows;
  assert(rows.size() >= 2 && rows.front().pilot_deg > rows.back().pilot_deg);
  const double start_n_mm = sheet.at(way.x_of(rows.front().pilot_deg)).potential;
  double taken = 0, least_mm = rows.front().locks_mm();
  const auto see = [&](double x) {
    least_mm = std::min(least_mm, (start_n_mm - sheet.at(x).potential) / taken);
  };
  for (std::size_t k = 1; k < rows.size(); ++k) {
    taken += integral(rows[k - 1].pilot_deg, rows[k - 1].loss_n, rows[k].pilot_deg, rows[k].loss_n);
    see(way.x_of(rows[k].pilot_deg));
  }
  // The power between the last two rows also holds below.
  const PinFriction::Row &last = rows.back(), &before = rows[rows.size() - 2];
  const double power =
      std::log(before.loss_n / last.loss_n) / std::log(before.pilot_deg / last.pilot_deg);
  taken += last.loss_n * last.pilot_deg * kRadPerDeg / (std::max(power, 0.0) + 1);
  see(0);
  if (least_mm > 0) friction.critical_mm = least_mm;
}

}  // namespace

const PinFriction::Row& PinFriction::locks_first() const {
  assert(!rows.empty());
  return *std::ranges::min_element(rows, {}, &Row::locks_mm);
}

std::optional<double> PinFriction::stall_deg(double mu_r_mm) const {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double least_mm = rows[k].locks_mm();
    if (least_mm > mu_r_mm) continue;
    if (k == 0) return rows[0].pilot_deg;
    const double before = rows[k - 1].locks_mm(), share = (before - mu_r_mm) / (before - least_mm);
    return rows[k - 1].pilot_deg + share * (rows[k].pilot_deg - rows[k - 1].pilot_deg);
  }
  return {};
}

StudyResult<PinStudy> study_pins(const Sheet& sheet, const ReleaseOptions& deploying, double own_mm,
                                 double to_deg) {
  const StudyResult<ReleaseOptions> fitted = validated_release(sheet, deploying);
  assert(to_deg > 0);
  if (!fitted) return fitted.obstacle();
  const double from_deg = fitted->motion.from_deg;
  if (to_deg >= from_deg) {
    return OptionFault{
        "margin_to_deg", shown("%g", to_deg),
        "pins are asked from the start, " + shown("%g", from_deg) + " deg, down to this angle",
        "name a smaller one, such as 1"};
  }
  std::vector<double> pilot_deg;
  for (int k = 0; k <= kPinRows; ++k) {
    pilot_deg.push_back(from_deg * std::pow(to_deg / from_deg, static_cast<double>(k) / kPinRows));
  }
  const EnergyModel moved(sheet, deploying.sheet);
  PinStudy study = loads_at(moved, sheet.model(), pilot_deg);
  study.own_mm = own_mm;
  for (PinFriction* pins : {&study.in_middle, &study.at_ends}) find_critical(moved, *pins);
  return study;
}

}  // namespace misalign::solver
