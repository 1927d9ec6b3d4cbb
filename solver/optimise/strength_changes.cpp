#include "solver/optimise/strength_changes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "solver/bending/buckling.hpp"
#include "solver/contact/contact.hpp"
#include "solver/optimise/body_distance.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Panels count whose stress, or inverse factor, is at least this share of the largest.
constexpr double kNearTheWorst = 0.7;
// Pairs of springs whose clearance exceeds the least by no more than this share of a diameter, at
// the angles that are compared.
constexpr double kNearTheClosest = 0.5;
constexpr int kClearanceAngles = 12;
// Difference of a force over the largest: buckling is linear in them but for its kind.
constexpr double kForceStep = 1e-6;

// Gradients of the forces of springs on bent panels, which follow from those on rigid ones.
class BentForces {
 public:
  /// The changes' sheet can be bent.
  explicit BentForces(SheetChanges& changes) : changes_(changes), springs_(changes) {}

  const EnergyModel& rigid() const { return springs_.rigid(); }
  /// Gradient of the weighted sum of the forces f at one of the bent angles, with C and K
  /// symmetric: (1 + K C) f = F, so that df = (1 + K C)^-1 (dF - dK C f).
  VectorXd row(std::size_t angle, const VectorXd& weights) {
    const AtAngle& there = at(angle);
    const VectorXd of_rigid = there.softening.solve(weights);
    const RowVectorXd of_no_vertex = RowVectorXd::Zero(changes_.sheet.shifts_mm().size());
    return springs_.forces_row(there.rigid, of_rigid) -
           changes_.variables.row(of_no_vertex, of_rigid.dot(there.given_mm));
  }

 private:
  struct AtAngle {
    PathGradients::AtAngle rigid;
    Eigen::PartialPivLU<MatrixXd> softening;  // 1 + C K
    VectorXd given_mm;                        // C f of the diagonals with springs
  };

  const AtAngle& at(std::size_t angle) {
    const auto known = angles_.find(angle);
    if (known != angles_.end()) return known->second;
    const BentPanels& panels = *changes_.bent();
    const BentAngle& bent = panels.angles[angle];
    const MatrixXd& mm_per_n = panels.way->compliances()[angle].mm_per_n;
    const VectorXd n_per_mm = springs_.n_per_mm() * springs_.has_spring();
    const MatrixXd softening =
        MatrixXd::Identity(mm_per_n.rows(), mm_per_n.cols()) + mm_per_n * n_per_mm.asDiagonal();
    AtAngle there{changes_.at(bent.pilot_deg), softening.partialPivLu(),
                  springs_.has_spring().cwiseProduct(mm_per_n * bent.bent.forces_n)};
    return angles_.emplace(angle, std::move(there)).first->second;
  }

  SheetChanges& changes_;
  const SpringChanges springs_;
  std::map<std::size_t, AtAngle> angles_;
};

}  // namespace

std::vector<GoalTerm> local_stress(SheetChanges& changes) {
  const auto& bent = changes.bent();
  if (!bent) return {};
  BentForces forces(changes);
  const VectorXd mpa_per_mm = bent->way->panels().stress_mpa_per_mm();
  const double least_mpa = kNearTheWorst * bent->most_bent().largest_stress_mpa;
  std::vector<GoalTerm> terms;
  for (std::size_t a = 0; a < bent->angles.size(); ++a) {
    const VectorXd& saddles_mm = bent->angles[a].bent.saddles_mm;
    for (Index panel = 0; panel < saddles_mm.size(); ++panel) {
      const double mpa = std::abs(saddles_mm(panel)) * mpa_per_mm(panel);
      if (mpa < least_mpa) continue;
      const double side = saddles_mm(panel) < 0 ? 1 : -1;  // of the negative stress
      const VectorXd by_force = bent->way->compliances()[a].saddle_mm_per_n.row(panel).transpose();
      terms.push_back({-mpa, 1, side * mpa_per_mm(panel) * forces.row(a, by_force)});
    }
  }
  return terms;
}

std::vector<GoalTerm> local_buckling(SheetChanges& changes) {
  const auto& bent = changes.bent();
  if (!bent) return {};
  BentForces forces(changes);
  const BucklingStudy study = find_buckling(changes.sheet, changes.options.deploying.sheet, *bent);
  const auto panels = buckling_panels(changes.sheet, bent->options.material, bent->thickness_mm);
  std::map<std::size_t, std::vector<std::size_t>> at_angle;  // panels
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const double factor = study.panels[k].factor;
    if (!std::isfinite(factor) || kNearTheWorst * factor > study.least().factor) continue;
    const auto angle =
        std::ranges::find(bent->angles, study.panels[k].pilot_deg, &BentAngle::pilot_deg);
    at_angle[static_cast<std::size_t>(angle - bent->angles.begin())].push_back(k);
  }
  std::vector<GoalTerm> terms;
  for (const auto& [a, its_panels] : at_angle) {
    const VectorXd& forces_n = bent->angles[a].bent.forces_n;
    const double step_n = kForceStep * forces_n.cwiseAbs().maxCoeff();
    std::vector<VectorXd> beside;
    for (Index d = 0; d < forces_n.size(); ++d) {
      beside.emplace_back(forces_n + step_n * VectorXd::Unit(forces_n.size(), d));
    }
    const auto in_plane =
        plane_forces(changes.sheet, forces.rigid(),
                     std::vector<double>(beside.size(), bent->angles[a].pilot_deg), beside);
    for (const std::size_t k : its_panels) {
      const double factor = study.panels[k].factor;
      VectorXd by_force(forces_n.size());
      for (Index d = 0; d < forces_n.size(); ++d) {
        const PlaneForces& there = in_plane[static_cast<std::size_t>(d)][k];
        by_force(d) = (buckling_factor(panels[k], there).factor - factor) / step_n;
      }
      terms.push_back({factor, 1, forces.row(a, by_force)});
    }
  }
  return terms;
}

std::vector<GoalTerm> local_spring_clearance(SheetChanges& changes) {
  const Sheet& sheet = changes.sheet;
  const auto& bodies = changes.options.bodies;
  if (!bodies || !sheet.base().springs.at_vertices()) return {};
  const auto study = contact(sheet, {{}, changes.options.used_from_deg, bodies});
  const SpringMeeting* const closest =
      study && study->springs ? closest_meeting(*study->springs) : nullptr;
  if (closest == nullptr) return {};
  std::vector<double> angles_deg{closest->pilot_deg};
  for (int k = 1; k <= kClearanceAngles; ++k) {
    angles_deg.push_back(study->reach_deg * k / kClearanceAngles);
  }
  const std::vector<int> sprung = sprung_diagonals(filling_of(sheet, bodies->fill));
  const auto outlines = trimmed_panels(sheet.panels(), sheet.way()->from_a1_mm(), study->trim_mm);
  std::vector<GoalTerm> terms;
  for (const double pilot_deg : angles_deg) {
    if (pilot_deg <= 0) continue;
    const auto folded = changes.gradients.vertices(pilot_deg);
    if (!folded) return {};
    const auto axis = [&](int d) {
      const Diagonal& diagonal = sheet.mechanism().diagonals[static_cast<std::size_t>(d)];
      const double flat_mm = changes.flat.length_mm(d);
      return placed_line(*folded, diagonal.from, diagonal.to, bodies->left_out_mm() / flat_mm);
    };
    const auto add = [&](const LengthGradient& apart, double bodies_mm) {
      const double clear_mm = apart.mm - bodies_mm;
      if (clear_mm > closest->clear_mm + kNearTheClosest * bodies->diameter_mm) return;
      terms.push_back({clear_mm, 1, changes.variables.row(apart.by_mm)});
    };
    for (std::size_t i = 0; i < sprung.size(); ++i) {
      for (std::size_t j = i + 1; j < sprung.size(); ++j) {
        add(distance_gradient(axis(sprung[i]), axis(sprung[j]), *folded), bodies->diameter_mm);
      }
    }
    if (const auto& by_panel = study->springs->panels.closest) {
      const PlacedBody panel = placed_panel(sheet, *folded, by_panel->panel,
                                            outlines[static_cast<std::size_t>(by_panel->panel)]);
      add(distance_gradient(axis(by_panel->spring), panel, *folded),
          by_panel->apart_mm - by_panel->clear_mm);
    }
  }
  return terms;
}

}  // namespace misalign::solver
