#include "solver/optimise/chosen_friction.hpp"

#include <cassert>

namespace misalign::solver {

using Eigen::VectorXd;

SpringChoiceOptions choice_of(const ReleaseOptions& deploying, double to_deg) {
  SpringChoiceOptions choice;
  choice.from_deg = deploying.from_deg;
  choice.to_deg = to_deg;
  choice.most_rate_n_per_mm = deploying.sheet.springs().stiffness_n_per_mm;
  return choice;
}

std::optional<double> chosen_friction_n_mm_per_mm(const Sheet& sheet,
                                                  const OptimiseOptions& options) {
  const auto choice = choose_springs(sheet, choice_of(options.deploying, options.bending.to_deg));
  return choice && choice->drives() ? std::optional(choice->static_n_mm_per_mm) : std::nullopt;
}

std::vector<GoalTerm> local_chosen_friction(SheetChanges& changes) {
  const OptimiseOptions& options = changes.options;
  const auto choice =
      choose_springs(changes.sheet, choice_of(options.deploying, options.bending.to_deg));
  if (!choice || !choice->drives()) return {};
  assert(choice->options.most_rate_n_per_mm > 0);
  const VectorXd& flat_mm = changes.flat.length_mm;
  VectorXd rates_n_per_mm = VectorXd::Zero(flat_mm.size()),
           of_flat = VectorXd::Ones(flat_mm.size());
  for (const ChosenSpring& spring : choice->springs) {
    rates_n_per_mm(spring.diagonal) = spring.rate_n_per_mm;
    of_flat(spring.diagonal) = spring.free_mm / flat_mm(spring.diagonal);
  }
  std::vector<GoalTerm> terms;
  for (const DrivenPlace& place : choice->rows) {
    const PathGradients::AtAngle at_angle = changes.at(place.pilot_deg);
    const auto slopes = changes.gradients.slopes(place.pilot_deg);
    if (!slopes) continue;  // next to the end of the way
    const VectorXd& slope_mm_per_rad = slopes->slope_mm_per_rad;
    const VectorXd forces_n =
        rates_n_per_mm.cwiseProduct(at_angle.length_mm - of_flat.cwiseProduct(flat_mm));
    const double moment_n_mm = forces_n.dot(slope_mm_per_rad);
    // Slopes and turning of a place are by the way's coordinate.
    const double rad = place.slope_mm.dot(slope_mm_per_rad) / slope_mm_per_rad.squaredNorm();
    const Eigen::RowVectorXd by_mm =
        rates_n_per_mm.cwiseProduct(slope_mm_per_rad).transpose() *
            (at_angle.length_by_mm - of_flat.asDiagonal() * changes.flat.length_by_mm) +
        forces_n.transpose() * slopes->slope_by_mm;
    terms.push_back(
        {moment_n_mm, place.turning_mm / rad,
         changes.variables.row(by_mm, moment_n_mm / choice->options.most_rate_n_per_mm)});
  }
  return terms;
}

}  // namespace misalign::solver
