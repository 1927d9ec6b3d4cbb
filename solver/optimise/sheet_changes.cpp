#include "solver/optimise/sheet_changes.hpp"

#include <cassert>

namespace misalign::solver {

using Eigen::VectorXd;

namespace {

EnergyModel::Options with_springs(EnergyModel::Options options, const Springs& springs) {
  options.fill = springs;
  return options;
}

}  // namespace

SpringChanges::SpringChanges(SheetChanges& changes, const Springs& springs)
    : changes_(changes),
      springs_(springs),
      rigid_(changes.sheet, with_springs(changes.options.deploying.sheet, springs)),
      has_spring_((rigid_.filling().rates_n_per_mm().array() > 0).cast<double>()),
      side_(has_spring_.cwiseProduct(sides_of_diagonals(*changes.sheet.way()))),
      preload_n_(
          side_.cwiseProduct(springs_.preload.forces_n(changes.sheet.mechanism().diagonals))),
      rest_mm_(changes.flat.length_mm),
      rest_by_mm_(changes.flat.length_by_mm) {
  const auto rests_at = [&](const PathGradients::AtAngle& there, Eigen::Index d) {
    rest_mm_(d) = there.length_mm(d);
    rest_by_mm_.row(d) = there.length_by_mm.row(d);
  };
  if (springs_.rest_deg > 0) {
    const PathGradients::AtAngle there = changes.at(springs_.rest_deg);
    for (Eigen::Index d = 0; d < rest_mm_.size(); ++d) rests_at(there, d);
  }
  for (const auto& [diagonal, rest_deg] : springs_.other_rests_deg) {
    rests_at(changes.at(rest_deg), diagonal);
  }
}

VectorXd SpringChanges::forces_n(const PathGradients::AtAngle& at_angle) const {
  return n_per_mm() * has_spring_.cwiseProduct(at_angle.length_mm - rest_mm_) + preload_n_;
}

VectorXd SpringChanges::forces_row(const PathGradients::AtAngle& at_angle,
                                   const VectorXd& weights) const {
  assert(weights.size() == rest_mm_.size());
  const VectorXd of_springs = weights.cwiseProduct(has_spring_);
  return changes_.variables.row(
      n_per_mm() * of_springs.transpose() * (at_angle.length_by_mm - rest_by_mm_),
      of_springs.dot(at_angle.length_mm - rest_mm_), of_springs.dot(side_));
}

VectorXd SpringChanges::energy_row(const PathGradients::AtAngle& at_angle,
                                   const VectorXd& forces_n) const {
  assert(forces_n.size() == rest_mm_.size() && n_per_mm() > 0);
  const VectorXd longer_mm = forces_n / n_per_mm();
  return changes_.variables.row(
      forces_n.transpose() * (at_angle.length_by_mm - rest_by_mm_),
      longer_mm.squaredNorm() / 2 - longer_mm.dot(preload_n_) / n_per_mm(), longer_mm.dot(side_));
}

}  // namespace misalign::solver
