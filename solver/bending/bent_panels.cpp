#include "solver/bending/bent_panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::VectorXd;

// Ratio of the least angle computed to the least angle requested.
constexpr double kBelow = 0.9;
// Number of intervals between angles, in geometric progression, at which friction is compared.
constexpr int kRows = 40;

std::vector<Matrix3Xd> shapes_at(const Sheet& sheet, const VectorXd& pilot_deg) {
  std::vector<Matrix3Xd> shapes_mm;
  for (const double angle_deg : pilot_deg) shapes_mm.push_back(sheet.at(angle_deg).vertices_mm);
  return shapes_mm;
}

double angle_of_row(double from_deg, double to_deg, int row, int rows) {
  return from_deg * std::pow(to_deg / from_deg, static_cast<double>(row) / rows);
}

// An equilibrium at one of the angles.
struct Followed {
  double turned_mm, n_mm, moment_n;
};

// Tolerance of the energy's rise between two equilibria of one path, whose moments give powers of
// the turning with slowly changing exponents. Another equilibrium has several times the energy.
constexpr double kSameEnergy = 0.1;

bool is_same(const Followed& below, const Followed& above) {
  const auto exponent = [](const Followed& at) { return at.moment_n * at.turned_mm / at.n_mm; };
  const double expected =
      (exponent(below) + exponent(above)) / 2 * std::log(above.turned_mm / below.turned_mm);
  return below.n_mm < above.n_mm &&
         std::abs(std::log(above.n_mm / below.n_mm) - expected) <= kSameEnergy;
}

// Bisects for the first angle down from the start, between two rows, at which the moment no longer
// suffices.
double stall_between(const EnergyCurve& curve, const OtherMomentsAt& others, double friction,
                     double moves_deg, double held_deg) {
  for (int k = 0; k < 40; ++k) {
    const double middle_deg = (moves_deg + held_deg) / 2;
    const OtherMoments other = others(middle_deg);
    const bool moves = curve.at(middle_deg).moment_n + other.moment_n > friction + other.balls_n;
    (moves ? moves_deg : held_deg) = middle_deg;
  }
  return held_deg;
}

// Finds the largest friction of the creases with which it gets from the start to flat.
void find_critical(const EnergyCurve& curve, const OtherMomentsAt& others, BentFriction& friction) {
  const double from_deg = curve.most_deg();
  constexpr int kSteps = 200;
  const EnergyCurve::At start = curve.at(from_deg);
  const OtherMoments other = others(from_deg);
  double least = start.moment_n + other.moment_n - other.balls_n, least_deg = from_deg;
  double balls_n_mm = 0, balls_n = other.balls_n, turned_mm = start.turned_mm;
  const auto see = [&](double energy_n_mm, double turned_here_mm, double at_deg) {
    const double value =
        (start.n_mm + other.n_mm - energy_n_mm - balls_n_mm) / (start.turned_mm - turned_here_mm);
    if (value < least) least = value, least_deg = at_deg;
  };
  for (int k = 1; k <= kSteps; ++k) {
    const double at_deg = angle_of_row(from_deg, curve.least_deg(), k, kSteps);
    const EnergyCurve::At point = curve.at(at_deg);
    const OtherMoments rest = others(at_deg);
    balls_n_mm += (balls_n + rest.balls_n) / 2 * (turned_mm - point.turned_mm);
    balls_n = rest.balls_n;
    turned_mm = point.turned_mm;
    see(point.n_mm + rest.n_mm, point.turned_mm, at_deg);
  }
  balls_n_mm += balls_n * turned_mm;
  see(0, 0, 0);
  if (least <= 0) return;
  friction.critical_n_mm_per_mm = least;
  friction.critical_deg = least_deg;
}

}  // namespace

OtherMomentsAt other_moments(const EnergyModel& sheet) {
  const double flat_n_mm = sheet.all_else(0).energy;
  return [&sheet, flat_n_mm](double pilot_deg) {
    const double x = sheet.way().x_of(pilot_deg);
    const EnergyModel::Potential rest = sheet.all_else(x);
    const EnergyModel::Turning turning = sheet.turning(x);
    return OtherMoments{
        rest.energy - flat_n_mm, rest.slope / turning.creases_mm,
        sheet.options().joints.ball_friction_n_mm * turning.balls / turning.creases_mm};
  };
}

BentWay::BentWay(const Sheet& sheet, const PanelMaterial& material, double thickness_mm,
                 double to_deg, double from_deg, int angles)
    : panels_(sheet.vertices_mm(), sheet.panels(), sheet.mechanism().diagonals, material,
              thickness_mm),
      least_deg_(kBelow * to_deg),
      from_deg_(from_deg),
      pilot_deg_(EnergyCurve::angles_deg(least_deg_, from_deg, angles)),
      folded_mm_(shapes_at(sheet, pilot_deg_)) {
  for (const Matrix3Xd& folded_mm : folded_mm_) {
    std::optional<Compliance> compliance = find_compliance(panels_, folded_mm);
    is_known_ = is_known_ && compliance;
    if (!is_known_) return;
    compliances_.push_back(std::move(*compliance));
  }
}

std::vector<BentAngle> BentWay::bend(const Filling& filling, BendMethod method,
                                     std::unique_ptr<BentFollower> start) const {
  std::vector<BentAngle> angles;
  for (std::size_t k = 0; k < compliances_.size(); ++k) {
    angles.push_back({pilot_deg_(static_cast<Index>(k)),
                      filling.energy_n_mm(compliances_[k].lengths_mm),
                      {},
                      true});
  }
  if (method == BendMethod::newton) bend_far(filling, std::move(start), angles);
  for (std::size_t k = 0; k < compliances_.size(); ++k) {
    BentAngle& angle = angles[k];
    if (method == BendMethod::linear || !angle.is_sure) {
      angle.bent = solver::bend(compliances_[k], filling);
    }
  }
  return angles;
}

// Follows the equilibrium down from the start; where it is lost, begins with the rigid sheet again.
void BentWay::bend_far(const Filling& filling, std::unique_ptr<BentFollower> follower,
                       std::vector<BentAngle>& angles) const {
  const bool is_relaxed_flat = filling.forces_n(panels_.flat_lengths_mm()).isZero(0);
  std::optional<Followed> above;
  for (std::size_t k = angles.size(); k-- > 0;) {
    const double turned_mm = compliances_[k].turned_mm;
    bool is_followed = follower && follower->follow(turned_mm);
    if (!is_followed) {
      follower = std::make_unique<BentFollower>(panels_, filling, folded_mm_[k]);
      is_followed = follower->follow(turned_mm);
    }
    BentAngle& angle = angles[k];
    angle.is_sure = is_followed;
    if (!is_followed) {
      follower.reset();
      continue;
    }
    const Followed below{turned_mm, follower->state().n_mm, follower->state().moment_n};
    if (is_relaxed_flat && above && !is_same(below, *above)) {
      angle.is_sure = false;
      continue;
    }
    angle.bent = follower->state();
    above = below;
  }
}

Bending BentWay::bending(const Filling& filling) const {
  auto start = std::make_unique<BentFollower>(panels_, filling, folded_mm_.back());
  if (!start->follow(compliances_.back().turned_mm)) return {BendMethod::newton, 1};
  const double ratio = start->state().n_mm / solver::bend(compliances_.back(), filling).n_mm;
  return {std::abs(ratio - 1) <= kLinearError ? BendMethod::linear : BendMethod::newton, ratio,
          std::move(start)};
}

EnergyCurve BentWay::curve(const Filling& filling, const std::vector<BentAngle>& angles) const {
  const VectorXd& flat_mm = panels_.flat_lengths_mm();
  const double flat_n_mm = filling.energy_n_mm(flat_mm);
  const Eigen::ArrayXd flat_n = filling.forces_n(flat_mm).cwiseAbs();
  VectorXd above(pilot_deg_.size()), reference(pilot_deg_.size()), turned(pilot_deg_.size());
  for (Index k = 0; k < pilot_deg_.size(); ++k) {
    const Compliance& compliance = compliances_[static_cast<std::size_t>(k)];
    above(k) = angles[static_cast<std::size_t>(k)].bent.n_mm - flat_n_mm;
    turned(k) = compliance.turned_mm;
    const Eigen::ArrayXd longer = (compliance.lengths_mm - flat_mm).array().abs();
    const Eigen::ArrayXd n_per_mm =
        filling.stiffness_n_per_mm(compliance.lengths_mm).diagonal().cwiseAbs();
    const Eigen::ArrayXd stiffer = 1 + n_per_mm * compliance.mm_per_n.diagonal().array();
    reference(k) = ((n_per_mm * longer.square() / 2 + flat_n * longer) / stiffer).sum();
  }
  return {least_deg_, from_deg_, above, reference, turned};
}

BentFriction find_bent_friction(const EnergyCurve& curve, double to_deg,
                                double friction_n_mm_per_mm, const OtherMomentsAt& others) {
  BentFriction friction;
  find_critical(curve, others, friction);
  friction.static_n_mm_per_mm = std::numeric_limits<double>::infinity();
  const double from_deg = curve.most_deg();
  for (int row = 0; row <= kRows; ++row) {
    const double at_deg = angle_of_row(from_deg, to_deg, row, kRows);
    const OtherMoments other = others(at_deg);
    StaticMargin entry{at_deg, curve.at(at_deg).moment_n + other.moment_n, {}};
    if (entry.available_n - other.balls_n < friction.static_n_mm_per_mm) {
      friction.static_n_mm_per_mm = entry.available_n - other.balls_n;
      friction.static_deg = at_deg;
    }
    const double resisting = friction_n_mm_per_mm + other.balls_n;
    if (resisting > 0) {
      entry.margin = entry.available_n / resisting - 1;
      friction.static_margin =
          std::min(friction.static_margin.value_or(*entry.margin), *entry.margin);
      if (*entry.margin <= 0 && !friction.static_stall_deg) {
        friction.static_stall_deg = row == 0
                                        ? at_deg
                                        : stall_between(curve, others, friction_n_mm_per_mm,
                                                        friction.rows.back().pilot_deg, at_deg);
      }
    }
    friction.rows.push_back(entry);
  }
  return friction;
}

Eigen::MatrixXd BentPanels::stress_mpa() const {
  const VectorXd mpa_per_mm = way->panels().stress_mpa_per_mm();
  Eigen::MatrixXd stress_mpa(mpa_per_mm.size(), std::ssize(angles));
  for (Index k = 0; const BentAngle& angle : angles) {
    stress_mpa.col(k++) = angle.bent.saddles_mm.cwiseAbs().cwiseProduct(mpa_per_mm);
  }
  return stress_mpa;
}

BentPanels::MostBent BentPanels::most_bent() const {
  Index panel = 0, k = 0;
  const double largest_mpa = stress_mpa().maxCoeff(&panel, &k);
  const BentAngle& angle = angles[static_cast<std::size_t>(k)];
  return {angle.pilot_deg, angle.bent.largest_saddle_mm(), largest_mpa};
}

int BentPanels::unsure() const {
  return static_cast<int>(std::count_if(angles.begin(), angles.end(),
                                        [](const auto& angle) { return !angle.is_sure; }));
}

StudyResult<BentPanels> bend_panels(const Sheet& sheet, const ReleaseOptions& deploying,
                                    const BentPanelsOptions& options) {
  const StudyResult<ReleaseOptions> fitted = validated_release(sheet, deploying);
  if (!fitted) return fitted.obstacle();
  const double from_deg = fitted->motion.from_deg;
  const EnergyModel::Options& held = deploying.sheet;
  if (!sheet.base().springs.at_vertices()) {
    return OptionFault{
        "panels", "bend",
        "bent panels are those of springs on the vertices, and these end beside them",
        "take rigid panels, or \"springs\" out of the pattern"};
  }
  if (options.to_deg >= from_deg) {
    return OptionFault{
        "margin_to_deg", shown("%g", options.to_deg),
        "margins are asked from the start, " + shown("%g", from_deg) + " deg, down to this angle",
        "name a smaller one, such as 1"};
  }
  const double thickness_mm = held.plates.thickness_mm;
  auto made = std::make_shared<const BentWay>(sheet, options.material, thickness_mm, options.to_deg,
                                              from_deg, options.angles);
  const BentWay& way = *made;
  if (!way.is_known()) return NoResult::panels_not_stable;
  const EnergyModel rigid(sheet, held);
  const Filling& filling = rigid.filling();
  if (filling.energy_n_mm(way.compliances().back().lengths_mm) <= 0) {
    return OptionFault{"fill",
                       {},
                       "stores no energy at the start, so that nothing bends the panels",
                       "give springs or plates that do"};
  }
  auto [method, newton_over_linear, start] =
      options.method ? Bending{*options.method, 1} : way.bending(filling);
  std::vector<BentAngle> angles = way.bend(filling, method, std::move(start));
  const EnergyCurve curve = way.curve(filling, angles);
  const OtherMomentsAt others = other_moments(rigid);
  const double friction = held.joints.friction_n_mm_per_mm;
  return BentPanels{options,
                    from_deg,
                    thickness_mm,
                    method,
                    newton_over_linear,
                    std::move(angles),
                    curve,
                    find_bent_friction(curve, options.to_deg, friction, others),
                    std::move(made)};
}

}  // namespace misalign::solver
