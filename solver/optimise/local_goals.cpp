#include "solver/optimise/local_goals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/bending/preload.hpp"
#include "solver/bending/rest_stiffness.hpp"
#include "solver/contact/contact.hpp"
#include "solver/optimise/deployed_angle.hpp"
#include "solver/optimise/spare_diagonals.hpp"
#include "solver/optimise/thickness_changes.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Number of angles besides flat at which the energies of rigid panels are evaluated.
constexpr int kGoalAngles = 6;
// Sections whose ratio is below kNearTheLeast times the least one also get the gradient of their
// divisor, by a step of kAlong_mm: far above the rounding of gradients, 1e-9, and small against
// their curvature.
constexpr double kNearTheLeast = 1.5, kAlong_mm = 1e-4;
// Changes of diagonals are evaluated to kBeyond_deg beyond the first reversal, in steps of
// kStep_deg.
constexpr double kBeyond_deg = 4, kStep_deg = 1;
// Number of angles at which moments are evaluated.
constexpr Index kMomentAngles = 12;

// Energy over the creases' turning, and the gradient of the energy, at an angle.
GoalTerm energy_at(const SheetChanges& changes, const SpringChanges& springs,
                   const PathGradients::AtAngle& at_angle, double n_mm, const VectorXd& forces_n) {
  VectorXd folds_rad, rates;
  const FoldingWay& way = *changes.sheet.way();
  way.find_creases(way.x_of(at_angle.pilot_deg), folds_rad, rates);
  double turned_mm = 0;
  for (Index c = 0; c < folds_rad.size(); ++c) {
    const Crease& crease = changes.sheet.mechanism().creases[static_cast<std::size_t>(c)];
    turned_mm += (changes.sheet.point_mm(crease.b) - changes.sheet.point_mm(crease.a)).norm() *
                 std::abs(folds_rad(c));
  }
  return {n_mm, turned_mm, springs.energy_row(at_angle, forces_n)};
}

// Energies at ascending angles, flat first.
std::vector<GoalTerm> rigid_energies(SheetChanges& changes) {
  const SpringChanges springs(changes);
  std::vector<GoalTerm> all;
  for (int k = 0; k <= kGoalAngles; ++k) {
    const double angle_deg = *changes.options.deploying.from_deg * k / kGoalAngles;
    const double x = changes.sheet.way()->x_of(angle_deg);
    all.push_back(energy_at(changes, springs, k == 0 ? changes.flat : changes.at(angle_deg),
                            springs.rigid().filled(x).energy, springs.rigid().filling_forces_n(x)));
  }
  return all;
}

std::vector<GoalTerm> bent_energies(SheetChanges& changes) {
  const auto& bent = changes.bent();
  if (!bent) return {};
  const SpringChanges springs(changes);
  const BentAngle& first = bent->angles.front();
  // Bending is not solved at flat; its change of the forces is that at the first bent angle.
  const PathGradients::AtAngle next_to_flat = changes.at(first.pilot_deg);
  const VectorXd bending_n = first.bent.forces_n - springs.forces_n(next_to_flat);
  const double flat_n_mm = first.bent.n_mm - bent->curve.at(first.pilot_deg).n_mm;
  std::vector<GoalTerm> all{energy_at(changes, springs, changes.flat, flat_n_mm,
                                      springs.forces_n(changes.flat) + bending_n)};
  for (const BentAngle& angle : bent->angles) {
    all.push_back(energy_at(changes, springs, changes.at(angle.pilot_deg), angle.bent.n_mm,
                            angle.bent.forces_n));
  }
  return all;
}

GoalTerm between(const GoalTerm& high, const GoalTerm& low) {
  assert(high.row.size() == low.row.size());
  return {high.numerator - low.numerator, high.divisor - low.divisor, high.row - low.row};
}

// Terms of the critical friction: from the angle of use to each smaller angle.
std::vector<GoalTerm> critical_frictions(const std::vector<GoalTerm>& energies) {
  std::vector<GoalTerm> terms;
  for (std::size_t k = 0; k + 1 < energies.size(); ++k) {
    terms.push_back(between(energies.back(), energies[k]));
  }
  return terms;
}

// Change of a diagonal's length in a section of the way, from one angle to the other.
struct Section {
  Index diagonal;
  double from_deg, to_deg, side, moved_mm;
  RowVectorXd by_mm;  // gradient by all vertices

  double ratio() const { return moved_mm / by_mm.norm(); }
};

// Gradient of the norm of a section's by_mm, as the difference of by_mm at a sheet that is shifted
// along it.
RowVectorXd norm_by_mm(SheetChanges& changes, const Section& section, SheetSolver& solver) {
  assert(section.by_mm.size() == changes.sheet.shifts_mm().size());
  const RowVectorXd along = section.by_mm.normalized();
  const Matrix2Xd shifts_mm =
      changes.sheet.shifts_mm() +
      kAlong_mm * Eigen::Map<const Matrix2Xd>(along.data(), 2, changes.sheet.shifts_mm().cols());
  const Sheet other(solver, shifts_mm);
  changes.is_known = changes.is_known && other.way();
  if (!changes.is_known) return 0 * along;
  PathGradients gradients(other);
  const auto from = gradients.at(section.from_deg, false), to = gradients.at(section.to_deg, false);
  changes.is_known = from && to;
  if (!changes.is_known) return 0 * along;
  const RowVectorXd by_mm = section.side * (to->length_by_mm.row(section.diagonal) -
                                            from->length_by_mm.row(section.diagonal));
  return (by_mm - section.by_mm) / kAlong_mm;
}

}  // namespace

std::vector<GoalTerm> local_critical_friction(SheetChanges& changes) {
  return critical_frictions(rigid_energies(changes));
}

std::vector<GoalTerm> local_bent_critical_friction(SheetChanges& changes) {
  return critical_frictions(bent_energies(changes));
}

std::vector<GoalTerm> local_static_friction(SheetChanges& changes) {
  const std::vector<GoalTerm> energies = bent_energies(changes);
  std::vector<GoalTerm> terms;
  // Static friction is evaluated above flat.
  for (std::size_t k = 1; k + 1 < energies.size(); ++k) {
    terms.push_back(between(energies[k + 1], energies[k]));
  }
  return terms;
}

std::vector<GoalTerm> local_energy(SheetChanges& changes) {
  GoalTerm stored = rigid_energies(changes).back();
  stored.divisor = 1;
  return {stored};
}

std::vector<GoalTerm> local_margin(SheetChanges& changes) {
  std::vector<Section> sections;
  PathGradients::AtAngle last = changes.flat;
  for (const int sample : changes.sheet.model().margin_samples()) {
    PathGradients::AtAngle at_angle = changes.at(changes.sheet.sample_deg(sample));
    for (Index d = 0; d < at_angle.length_mm.size(); ++d) {
      const double longer_mm = at_angle.length_mm(d) - last.length_mm(d);
      const double side = longer_mm < 0 ? -1 : 1;
      sections.push_back({d, last.pilot_deg, at_angle.pilot_deg, side, std::abs(longer_mm),
                          side * (at_angle.length_by_mm.row(d) - last.length_by_mm.row(d))});
    }
    last = std::move(at_angle);
  }
  SheetSolver solver(changes.sheet.model());
  double least = std::numeric_limits<double>::infinity();
  for (const Section& section : sections) least = std::min(least, section.ratio());
  std::vector<GoalTerm> terms;
  for (const Section& section : sections) {
    RowVectorXd row = section.by_mm;
    // The divisor changes too, which matters for the least terms.
    if (section.ratio() < kNearTheLeast * least)
      row -= section.ratio() * norm_by_mm(changes, section, solver);
    terms.push_back({section.moved_mm, section.by_mm.norm(), changes.variables.row(row)});
  }
  return terms;
}

std::vector<GoalTerm> local_deployed_angle(SheetChanges& changes) {
  const Sheet& sheet = changes.sheet;
  const double reached_deg = goes_until_deg(sheet), end_deg = sheet.way()->end_deg();
  const double asked_deg = sheet.sample_deg(changes.options.deploys_from_sample);
  PathGradients::AtAngle last = changes.at(asked_deg);
  const VectorXd side = (last.length_mm - changes.flat.length_mm).cwiseSign();
  std::vector<GoalTerm> terms;
  double most_mm = 0;
  for (double angle_deg = asked_deg + kStep_deg;
       angle_deg < std::min(reached_deg + kBeyond_deg, end_deg); angle_deg += kStep_deg) {
    PathGradients::AtAngle at_angle = changes.at(angle_deg);
    for (Index d = 0; d < side.size(); ++d) {
      terms.push_back({side(d) * (at_angle.length_mm(d) - last.length_mm(d)), 1,
                       changes.variables.row(
                           side(d) * (at_angle.length_by_mm.row(d) - last.length_by_mm.row(d)))});
      most_mm = std::max(most_mm, std::abs(terms.back().numerator));
    }
    last = std::move(at_angle);
  }
  if (const auto limit = changes.gradients.fold_limit();
      limit && end_deg < reached_deg + kBeyond_deg) {
    const double mm_per_deg = most_mm > 0 ? most_mm : 1;
    terms.push_back({mm_per_deg * (limit->fold_limit_deg - reached_deg), 1,
                     changes.variables.row(mm_per_deg * limit->by_mm)});
  }
  return terms;
}

std::vector<GoalTerm> local_rest_stiffness(SheetChanges& changes) {
  const ReleaseOptions& deploying = changes.options.deploying;
  const auto now = rest_stiffness(changes.sheet, deploying, changes.options.bending.material);
  if (!now) return {};
  const Springs& springs = deploying.sheet.springs();
  if (springs.rest_deg > 0) {
    const auto slopes = changes.gradients.slopes(springs.rest_deg);
    if (!slopes) return {};
    const double n_per_mm = springs.stiffness_n_per_mm;
    return {{now->n_mm_per_rad, 1,
             changes.variables.row(2 * now->forces_n.transpose() * slopes->slope_by_mm,
                                   now->forces_n.squaredNorm() / (n_per_mm * n_per_mm))}};
  }
  // Changes of length are proportional to the square of the angle next to flat.
  const PathGradients::AtAngle near = changes.at(kNearFlat_deg);
  const VectorXd longer_mm =
      SpringChanges(changes).has_spring().cwiseProduct(near.length_mm - changes.flat.length_mm);
  const VectorXd forces_n = springs.preload.forces_n(changes.sheet.mechanism().diagonals)
                                .cwiseProduct(longer_mm.cwiseSign());
  const double square = std::pow(kNearFlat_deg * kRadPerDeg, 2),
               preload_n = springs.preload.largest_n();
  return {{now->n_mm_per_rad, 1,
           changes.variables.row(
               2 / square * forces_n.transpose() * (near.length_by_mm - changes.flat.length_by_mm),
               0, 2 / square * longer_mm.cwiseAbs().sum() - 2 * preload_n * now->give_mm_per_n)}};
}

std::vector<GoalTerm> local_spare_diagonals(SheetChanges& changes) {
  const SpringChanges springs(changes);
  const auto now =
      spare_diagonals(changes.sheet, springs.rigid(), *changes.options.deploying.from_deg);
  if (!now || now->few.fewer.empty()) return {};
  std::vector<GoalTerm> all, fewer;
  const Index angles = now->pilot_deg.size(), step = std::max<Index>(1, angles / kMomentAngles);
  for (Index k = angles - 1; k >= 0; k -= step) {
    const PathGradients::AtAngle at_angle = changes.at(now->pilot_deg(k));
    const auto slopes = changes.gradients.slopes(at_angle.pilot_deg);
    if (!slopes) return {};
    const VectorXd forces_n = springs.forces_n(at_angle);
    const auto moment_of = [&](const VectorXd& chosen) {
      return GoalTerm{chosen.dot(forces_n.cwiseProduct(slopes->slope_mm_per_rad)), 1,
                      springs.forces_row(at_angle, chosen.cwiseProduct(slopes->slope_mm_per_rad)) +
                          changes.variables.row(chosen.cwiseProduct(forces_n).transpose() *
                                                slopes->slope_by_mm)};
    };
    VectorXd chosen = VectorXd::Zero(forces_n.size());
    for (const int diagonal : now->few.fewer) chosen(diagonal) = 1;
    all.push_back(moment_of(VectorXd::Ones(forces_n.size())));
    fewer.push_back(moment_of(chosen));
  }
  const GoalTerm& least = *std::ranges::min_element(all, {}, &GoalTerm::numerator);
  assert(all.size() == fewer.size());
  for (GoalTerm& term : fewer) {
    term.divisor = least.numerator;
    term.row -= term.numerator / least.numerator * least.row;
  }
  return fewer;
}

std::vector<GoalTerm> local_thickness(SheetChanges& changes) {
  std::vector<GoalTerm> terms;
  for (const LengthGradient& length :
       thickness_changes(changes.sheet, changes.gradients, changes.options.used_from_deg)) {
    terms.push_back({length.mm, 1, changes.variables.row(length.by_mm)});
  }
  return terms;
}

}  // namespace misalign::solver
