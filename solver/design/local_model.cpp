#include "solver/design/local_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/design/path_gradients.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Directions are looked at in long steps up to so far below the angle asked for, then in short
// ones, since near fold limits diagonals turn within degrees, and at last in one that shows which
// still go on there.
constexpr double kLong_deg = 4, kShort_deg = 1, kNearEnd_deg = 24, kLast_deg = 0.02;
// At which the goal of rigid panels is looked at, beside flat.
constexpr int kGoalAngles = 6;
// A fold limit stays so far beyond the angle asked for, and creases there so far from folded flat.
constexpr double kBeforeLimit_deg = 0.05, kBeforeFlat_deg = 1e-3;
// Of margins those within so much of the least are followed to second order, by sheets that are
// shifted by so much: between rounding of gradients, 1e-9, and their curvature.
constexpr double kNearTheLeast = 1.5, kAlong_mm = 1e-4;
// Fold angles are asked for from here on.
constexpr double kFoldedFar_deg = 150;

class Builder {
 public:
  Builder(const Sheet& sheet, const OptimiseOptions& options)
      : sheet_(sheet), options_(options), gradients_(sheet), flat_(at(0)) {}

  std::optional<LocalModel> build() {
    add_room();
    add_directions();
    model_.goals = goals_of(options_.goal);
    add_floors();
    if (!is_known_) return {};
    return std::move(model_);
  }

 private:
  AngleGradients at(double pilot_deg, bool with_folds = false) {
    auto found = gradients_.at(pilot_deg, with_folds);
    if (found) return std::move(*found);
    is_known_ = false;
    return flat_;
  }

  // Of all vertices' coordinates those that may change, or by the moves.
  VectorXd of_shifted(const Eigen::RowVectorXd& all) const {
    VectorXd row(2 * std::ssize(options_.shifted));
    Index k = 0;
    for (const int vertex : options_.shifted) {
      row(k++) = all(2 * vertex);
      row(k++) = all(2 * vertex + 1);
    }
    if (options_.moves.size() == 0) return row;
    return options_.moves.transpose() * row;
  }

  void add_room() {
    const Eigen::Map<const Eigen::RowVectorXd> all_mm(sheet_.shifts_mm().data(),
                                                      sheet_.shifts_mm().size());
    if (options_.moves.size() == 0) {
      const VectorXd own_mm = of_shifted(all_mm);
      model_.coordinates = own_mm.size();
      model_.rise_mm = options_.amplitude_mm - own_mm.array();
      model_.fall_mm = options_.amplitude_mm + own_mm.array();
      return;
    }
    model_.coordinates = options_.moves.cols();
    model_.rise_mm = model_.fall_mm =
        Eigen::ArrayXd::Constant(model_.coordinates, std::numeric_limits<double>::infinity());
    for (Index k = 0; k < options_.moves.rows(); ++k) {
      const int vertex = options_.shifted[static_cast<std::size_t>(k / 2)];
      const double own_mm = sheet_.shifts_mm()(k % 2, vertex);
      for (const double side : {-1.0, 1.0}) {
        model_.rows.push_back({LocalRow::Of::amplitude, static_cast<int>(k), 0,
                               options_.amplitude_mm - side * own_mm,
                               -side * options_.moves.row(k)});
      }
    }
  }

  void add(LocalRow::Of of, Index where, double pilot_deg, double slack,
           const Eigen::RowVectorXd& all) {
    model_.rows.push_back({of, static_cast<int>(where), pilot_deg, slack, of_shifted(all)});
  }

  static std::vector<double> angles_of_directions(double to_deg) {
    std::vector<double> angles_deg;
    for (double angle_deg = kLong_deg; angle_deg < to_deg;
         angle_deg += angle_deg < to_deg - kNearEnd_deg ? kLong_deg : kShort_deg) {
      angles_deg.push_back(angle_deg);
    }
    angles_deg.push_back(to_deg - kLast_deg);
    angles_deg.push_back(to_deg);
    return angles_deg;
  }

  void add_directions() {
    AngleGradients last = flat_;
    const double to_deg = sheet_.sample_deg(options_.deploys_from_sample);
    const AngleGradients end = at(to_deg, to_deg >= kFoldedFar_deg);
    const VectorXd longer_mm = end.length_mm - flat_.length_mm;
    for (const double pilot_deg : angles_of_directions(to_deg)) {
      AngleGradients here = pilot_deg == to_deg ? end : at(pilot_deg);
      const double least_mm = options_.least_slope_mm_per_deg *
                              half_angle_of_deg(pilot_deg + last.pilot_deg).s *
                              (pilot_deg - last.pilot_deg);
      for (Index d = 0; d < here.length_mm.size(); ++d) {
        const double side = longer_mm(d) < 0 ? -1 : 1;
        add(LocalRow::Of::direction, d, pilot_deg,
            side * (here.length_mm(d) - last.length_mm(d)) - least_mm,
            side * (here.length_by_mm.row(d) - last.length_by_mm.row(d)));
      }
      last = std::move(here);
    }
    if (to_deg >= kFoldedFar_deg) add_folds(end);
    if (options_.stroke_limit) {
      add_elongations(LocalRow::Of::stroke, sheet_.deploys_from_deg(), *options_.stroke_limit,
                      Eigen::ArrayXd::Zero(flat_.length_mm.size()));
    }
    if (options_.largest_force_n) {
      const Springs& springs = options_.deploying.sheet.springs;
      const VectorXd preload_n = springs.preload.forces_n(sheet_.mechanism().diagonals);
      add_elongations(LocalRow::Of::force, *options_.deploying.from_deg, 0,
                      (*options_.largest_force_n - preload_n.array()) / springs.stiffness_n_per_mm);
    }
  }

  void add_folds(const AngleGradients& here) {
    for (Index c = 0; c < here.fold_deg.size(); ++c) {
      if (static_cast<int>(c) == sheet_.mechanism().pilot) continue;
      const double side = here.fold_deg(c) < 0 ? -1 : 1;
      add(LocalRow::Of::fold_angle, c, here.pilot_deg,
          180 - kBeforeFlat_deg - side * here.fold_deg(c), -side * here.fold_by_mm.row(c));
    }
    if (const auto limit = gradients_.fold_limit()) {
      add(LocalRow::Of::fold_limit, 0, limit->fold_limit_deg,
          limit->fold_limit_deg - here.pilot_deg - kBeforeLimit_deg, limit->by_mm);
    }
  }

  // No diagonal by more than a share of its own and so many mm. Diagonals go one way up to D: at an
  // angle they have not been longer or shorter before.
  void add_elongations(LocalRow::Of of, double pilot_deg, double share,
                       const Eigen::ArrayXd& most_mm) {
    const AngleGradients here = at(pilot_deg);
    for (Index d = 0; d < here.length_mm.size(); ++d) {
      const double longer_mm = here.length_mm(d) - flat_.length_mm(d);
      const double side = longer_mm < 0 ? -1 : 1;
      add(of, d, pilot_deg, share * flat_.length_mm(d) + most_mm(d) - side * longer_mm,
          share * flat_.length_by_mm.row(d) -
              side * (here.length_by_mm.row(d) - flat_.length_by_mm.row(d)));
    }
  }

  // Energy, what the creases have turned, and how the first changes, at an angle.
  LocalGoal energy_at(double pilot_deg, double n_mm, const VectorXd& forces_n) {
    const AngleGradients here = at(pilot_deg);
    VectorXd folds_rad, rates;
    const FoldingWay& way = *sheet_.way();
    way.find_creases(way.x_of(pilot_deg), folds_rad, rates);
    double turned_mm = 0;
    for (Index c = 0; c < folds_rad.size(); ++c) {
      const Crease& crease = sheet_.mechanism().creases[static_cast<std::size_t>(c)];
      turned_mm +=
          (sheet_.point_mm(crease.b) - sheet_.point_mm(crease.a)).norm() * std::abs(folds_rad(c));
    }
    return {n_mm, turned_mm,
            of_shifted(forces_n.transpose() * (here.length_by_mm - flat_.length_by_mm))};
  }

  // In ascending angles, flat first.
  std::vector<LocalGoal> energies(bool panels_bend) {
    const DeployOptions& deploying = options_.deploying;
    std::vector<LocalGoal> all;
    if (!panels_bend) {
      const double from_deg = *deploying.from_deg;
      const DeployingSheet rigid(*sheet_.way(), sheet_.model().shape(), sheet_.base(),
                                 deploying.sheet);
      all.push_back({rigid.unit_springs(0).energy, 0, VectorXd()});
      for (int k = 1; k <= kGoalAngles; ++k) {
        const double angle_deg = from_deg * k / kGoalAngles, x = sheet_.way()->x_of(angle_deg);
        all.push_back(energy_at(angle_deg, rigid.unit_springs(x).energy, rigid.spring_forces_n(x)));
      }
      const double n_per_mm = deploying.sheet.springs.stiffness_n_per_mm;
      for (LocalGoal& one : all) one.amount *= n_per_mm;
    } else {
      const auto bent = bend_panels(sheet_, deploying, options_.bending).study;
      if (!bent) {
        is_known_ = false;
        return {};
      }
      const double flat_n_mm =
          bent->angles.front().bent.n_mm - bent->curve.at(bent->angles.front().pilot_deg).n_mm;
      all.push_back({flat_n_mm, 0, VectorXd()});
      for (const BentAngle& angle : bent->angles) {
        all.push_back(energy_at(angle.pilot_deg, angle.bent.n_mm, angle.bent.forces_n));
      }
    }
    all.front().row = VectorXd::Zero(model_.coordinates);
    return all;
  }

  // How far a diagonal goes on in a section of the way, from the one sample to the other.
  struct Section {
    Index diagonal;
    double from_deg, to_deg, side, moved_mm;
    Eigen::RowVectorXd by_mm;  // of all vertices

    double ratio() const { return moved_mm / by_mm.norm(); }
  };

  // As solver/model/miscut_margin.hpp has it: the amounts of all sections.
  std::vector<LocalGoal> margins() {
    std::vector<Section> sections;
    AngleGradients last = flat_;
    for (const int sample : sheet_.model().margin_samples()) {
      AngleGradients here = at(sheet_.sample_deg(sample));
      for (Index d = 0; d < here.length_mm.size(); ++d) {
        const double longer_mm = here.length_mm(d) - last.length_mm(d);
        const double side = longer_mm < 0 ? -1 : 1;
        sections.push_back({d, last.pilot_deg, here.pilot_deg, side, std::abs(longer_mm),
                            side * (here.length_by_mm.row(d) - last.length_by_mm.row(d))});
      }
      last = std::move(here);
    }
    SheetSolver solver(sheet_.model());
    double least = std::numeric_limits<double>::infinity();
    for (const Section& one : sections) least = std::min(least, one.ratio());
    std::vector<LocalGoal> all;
    for (const Section& one : sections) {
      Eigen::RowVectorXd row = one.by_mm;
      // What is divided by changes too; of the least ones that is looked at.
      if (one.ratio() < kNearTheLeast * least) row -= one.ratio() * norm_by_mm(one, solver);
      all.push_back({one.moved_mm, one.by_mm.norm(), of_shifted(row)});
    }
    return all;
  }

  // How the norm of a section's row changes, per mm: by the row of a sheet that is shifted along
  // it.
  Eigen::RowVectorXd norm_by_mm(const Section& section, SheetSolver& solver) {
    const Eigen::RowVectorXd along = section.by_mm.normalized();
    const Matrix2Xd shifts_mm =
        sheet_.shifts_mm() +
        kAlong_mm * Eigen::Map<const Matrix2Xd>(along.data(), 2, sheet_.shifts_mm().cols());
    const Sheet other(solver, shifts_mm);
    is_known_ = is_known_ && other.way();
    if (!is_known_) return 0 * along;
    PathGradients gradients(other);
    const auto from = gradients.at(section.from_deg, false),
               to = gradients.at(section.to_deg, false);
    is_known_ = from && to;
    if (!is_known_) return 0 * along;
    const Eigen::RowVectorXd by_mm = section.side * (to->length_by_mm.row(section.diagonal) -
                                                     from->length_by_mm.row(section.diagonal));
    return (by_mm - section.by_mm) / kAlong_mm;
  }

  std::vector<LocalGoal> goals_of(OptimiseGoal goal) {
    if (goal == OptimiseGoal::miscut_margin) return margins();
    const std::vector<LocalGoal> all = energies(goal != OptimiseGoal::critical_friction);
    std::vector<LocalGoal> goals;
    const auto add_between = [&](const LocalGoal& high, const LocalGoal& low) {
      goals.push_back({high.amount - low.amount, high.over - low.over, high.row - low.row});
    };
    const bool is_static = goal == OptimiseGoal::static_friction;
    for (std::size_t k = is_static ? 1 : 0; k + 1 < all.size(); ++k) {
      add_between(is_static ? all[k + 1] : all.back(), all[k]);
    }
    return goals;
  }

  // In units of the goal.
  void add_floors() {
    for (std::size_t floor = 0; floor < options_.floors.size(); ++floor) {
      const auto& [of, least] = options_.floors[floor];
      for (const LocalGoal& one : goals_of(of)) {
        model_.rows.push_back({LocalRow::Of::floor, static_cast<int>(floor), 0,
                               one.amount / one.over - least, one.row / one.over});
      }
    }
  }

  const Sheet& sheet_;
  const OptimiseOptions& options_;
  PathGradients gradients_;
  bool is_known_ = true;
  AngleGradients flat_;
  LocalModel model_;
};

}  // namespace

double LocalModel::goal(const VectorXd& change_mm) const {
  double least = std::numeric_limits<double>::infinity();
  for (const LocalGoal& one : goals) {
    least = std::min(least, (one.amount + one.row.dot(change_mm)) / one.over);
  }
  return least;
}

std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options) {
  assert(options.deploying.from_deg);
  if (!sheet.way() || sheet.model().has_spare_equations()) return {};
  return Builder(sheet, options).build();
}

}  // namespace misalign::solver
