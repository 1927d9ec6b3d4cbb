#include "solver/bending/bent_advice.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace misalign::solver {
namespace {

Filling springs_relaxed_flat(const BentWay& way, double n_per_mm) {
  const Eigen::VectorXd& flat_mm = way.panels().flat_lengths_mm();
  return Filling::of_springs(Eigen::VectorXd::Constant(flat_mm.size(), n_per_mm), flat_mm);
}

// Critical friction from all angles; none where Newton's method lost an equilibrium.
std::optional<double> critical_of(const BentWay& way, double n_per_mm, BendMethod method) {
  const Filling springs = springs_relaxed_flat(way, n_per_mm);
  const std::vector<BentAngle> angles = way.bend(springs, method);
  if (!std::all_of(angles.begin(), angles.end(), [](const auto& angle) { return angle.is_sure; })) {
    return {};
  }
  const auto nothing = [](double) { return OtherMoments{0, 0, 0}; };
  return find_bent_friction(way.curve(springs, angles), way.pilot_deg()(0), 0, nothing)
      .critical_n_mm_per_mm.value_or(0);
}

// Stiffness of springs that count as rigid, over the largest stiffness of the panels.
constexpr double kStiffSprings = 1e4;
// Softer springs than this share of that are not tried: they overcome almost no friction.
constexpr double kSoftSprings = 1e12;

// The least stiffness from which up to `much` the critical friction is at least `wanted`. Springs
// and panels are in series: the reciprocal of the friction is nearly linear in that of the
// stiffness, and false position on these (Illinois) takes few steps.
std::optional<double> least_stiffness(const BentWay& way, BendMethod method, double wanted,
                                      double much, double critical_of_much) {
  assert(wanted > 0 && much > 0 && wanted <= critical_of_much);
  struct Point {
    double mm_per_n, above;  // reciprocal stiffness; reciprocal friction, less the wanted
  };
  const auto at = [&](double mm_per_n) -> std::optional<Point> {
    const auto critical = critical_of(way, 1 / mm_per_n, method);
    if (!critical) return {};
    return Point{mm_per_n, 1 / *critical - 1 / wanted};
  };
  Point stiff{1 / much, 1 / critical_of_much - 1 / wanted}, soft = stiff;
  while (soft.above <= 0 && soft.mm_per_n * much < kSoftSprings) {
    const auto softer = at(16 * soft.mm_per_n);
    if (!softer) return {};
    stiff = std::exchange(soft, *softer);
  }
  if (soft.above <= 0) return 1 / soft.mm_per_n;
  const double close = method == BendMethod::linear ? 1.003 : 1.03;
  int stiffer_in_turn = 0;  // negative: softer
  while (soft.mm_per_n > close * stiff.mm_per_n) {
    assert(stiff.above <= 0 && soft.above > 0);
    // Steps go at least this far into the bracket, even where the softer springs overcome no
    // friction.
    const double share = std::clamp(stiff.above / (stiff.above - soft.above), 0.02, 0.98);
    const auto next = at(stiff.mm_per_n + share * (soft.mm_per_n - stiff.mm_per_n));
    if (!next) return {};
    const bool suffices = next->above <= 0;
    (suffices ? stiff : soft) = *next;
    stiffer_in_turn =
        suffices ? std::max(stiffer_in_turn, 0) + 1 : std::min(stiffer_in_turn, 0) - 1;
    if (stiffer_in_turn > 1) soft.above /= 2;
    if (stiffer_in_turn < -1) stiff.above /= 2;
  }
  return 1 / stiff.mm_per_n;
}

std::optional<double> least_thickness(const Sheet& sheet, const BentPanels& study,
                                      const Filling& filling, double friction, double wanted_margin,
                                      const OtherMomentsAt& others) {
  const double to_deg = study.options.to_deg;
  const auto suffices = [&](double thickness_mm) {
    const BentWay way(sheet, study.options.material, thickness_mm, to_deg, study.from_deg,
                      study.options.angles);
    if (!way.is_known()) return false;
    const EnergyCurve curve = way.curve(filling, way.bend(filling, BendMethod::linear));
    const auto margin = find_bent_friction(curve, to_deg, friction, others).static_margin;
    return margin && *margin >= wanted_margin;
  };
  double enough_mm = kMostThick_mm, little_mm = 1e-3;
  if (!suffices(enough_mm)) return {};
  while (enough_mm > 1.003 * little_mm) {
    const double middle_mm = std::sqrt(enough_mm * little_mm);
    assert(little_mm < middle_mm && middle_mm < enough_mm);
    (suffices(middle_mm) ? enough_mm : little_mm) = middle_mm;
  }
  return enough_mm;
}

}  // namespace

std::optional<double> useful_stiffness_n_per_mm(const BentWay& way) {
  double least_mm_per_n = std::numeric_limits<double>::infinity();
  for (const Compliance& compliance : way.compliances()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(compliance.mm_per_n,
                                                               Eigen::EigenvaluesOnly);
    // Eigenvalues below 1e-12 of the largest are rounding.
    least_mm_per_n = std::min(least_mm_per_n, std::max(eigen.eigenvalues().minCoeff(),
                                                       1e-12 * eigen.eigenvalues().maxCoeff()));
  }
  const double much = kStiffSprings / least_mm_per_n;
  const double most = critical_of(way, much, BendMethod::linear).value_or(0);
  if (most <= 0) return {};
  // These springs are within a percent of the largest friction, by Newton's method too.
  const auto stiff = least_stiffness(way, BendMethod::linear, 0.99 * most, much, most);
  const Filling springs = springs_relaxed_flat(way, stiff.value());
  if (way.bending(springs).method == BendMethod::linear) {
    return least_stiffness(way, BendMethod::linear, kUseful * most, much, most);
  }
  const auto far = critical_of(way, *stiff, BendMethod::newton);
  if (!far || *far <= 0) return {};
  return least_stiffness(way, BendMethod::newton, kUseful * *far, *stiff, *far);
}

BentAdvice advise(const Sheet& sheet, const ReleaseOptions& deploying, const BentPanels& study,
                  double wanted_margin) {
  const EnergyModel::Options& held = deploying.sheet;
  BentAdvice advice{useful_stiffness_n_per_mm(*study.way), wanted_margin, {}};
  const double friction = held.joints.friction_n_mm_per_mm;
  if (friction <= 0) return advice;
  const EnergyModel rigid(sheet, held);
  advice.least_thickness_mm =
      least_thickness(sheet, study, rigid.filling(), friction, wanted_margin, other_moments(rigid));
  return advice;
}

}  // namespace misalign::solver
