#include "solver/optimise/local_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/low_slopes.hpp"
#include "solver/studies/angle_of_use.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Steps between angles of direction rows: long ones up to kNearEnd_deg below the required angle,
// then short ones, since near fold limits diagonals turn back within degrees, and a last one that
// shows which still change there.
constexpr double kLong_deg = 4, kShort_deg = 1, kNearEnd_deg = 24, kLast_deg = 0.02;
// Distances to keep: of the fold limit from the required angle, and of creases there from folded
// flat.
constexpr double kBeforeLimit_deg = 0.05, kBeforeFlat_deg = 1e-3;
// Least required angle with which fold angles are constrained.
constexpr double kFoldedFar_deg = 150;

// Slopes below kLowSlopes times the least one have rows of their own, which keep them above it by
// the share kAboveLeast: less than what steps leave.
constexpr double kLowSlopes = 10, kAboveLeast = 0.1;

// Share of a distance's bound that steps leave for its curvature.
constexpr double kWithinBound = 0.1;

class Builder {
 public:
  Builder(const Sheet& sheet, const OptimiseOptions& options)
      : sheet_(sheet), options_(options), changes_(sheet, options), flat_(changes_.flat) {}

  std::optional<LocalModel> build() {
    add_room();
    add_way();
    model_.goals = linearization_of(*options_.goal, changes_);
    add_floors();
    if (!changes_.is_known || model_.goals.empty()) return {};
    return std::move(model_);
  }

 private:
  void add_room() {
    const Eigen::ArrayXd own_mm =
        changes_.variables.of(point_of(sheet_.shifts_mm(), options_)).array();
    model_.coordinates = own_mm.size();
    model_.rise_mm = options_.amplitude_mm - own_mm;
    model_.fall_mm = options_.amplitude_mm + own_mm;
    if (!changes_.variables.are_free()) return;
    const Index shifts = options_.moves.cols();
    model_.rise_mm.head(shifts) = model_.fall_mm.head(shifts) =
        std::numeric_limits<double>::infinity();
    for (Index k = 0; k < options_.moves.rows(); ++k) {
      const int vertex = options_.shifted[static_cast<std::size_t>(k / 2)];
      const double shift_mm = sheet_.shifts_mm()(k % 2, vertex);
      for (const double side : {-1.0, 1.0}) {
        VectorXd row = VectorXd::Zero(model_.coordinates);
        row.head(shifts) = -side * options_.moves.row(k);
        model_.rows.push_back({LocalModel::Row::Kind::amplitude, static_cast<int>(k), 0,
                               options_.amplitude_mm - side * shift_mm, row});
      }
    }
  }

  void add(LocalModel::Row::Kind kind, Index where, double pilot_deg, double slack,
           const Eigen::RowVectorXd& by_vertices) {
    model_.rows.push_back(
        {kind, static_cast<int>(where), pilot_deg, slack, changes_.variables.row(by_vertices)});
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

  void add_way() {
    const double to_deg = sheet_.sample_deg(options_.deploys_from_sample);
    // Sheets with a shape mostly have their fold limit next to the required angle.
    const bool has_folds = to_deg >= kFoldedFar_deg || options_.shape;
    const PathGradients::AtAngle end = changes_.at(to_deg, has_folds);
    if (const auto& energy = sheet_.model().criterion().energy) {
      add_rises(end, std::get<Springs>(energy->fill));
    } else {
      add_directions(end);
      if (options_.slope_at_every_angle && !options_.ternary) add_low_slopes(to_deg);
    }
    if (has_folds) add_folds(end);
    if (options_.stroke_limit) add_strokes(*options_.stroke_limit);
    if (options_.largest_force_n) add_forces(*options_.largest_force_n);
  }

  void add_directions(const PathGradients::AtAngle& end) {
    PathGradients::AtAngle last = flat_;
    const double to_deg = end.pilot_deg;
    const VectorXd longer_mm = end.length_mm - flat_.length_mm;
    for (const double pilot_deg : angles_of_directions(to_deg)) {
      PathGradients::AtAngle at_angle = pilot_deg == to_deg ? end : changes_.at(pilot_deg);
      const double least_mm = options_.least_slope_mm_per_deg *
                              half_angle_of_deg(pilot_deg + last.pilot_deg).s *
                              (pilot_deg - last.pilot_deg);
      for (Index d = 0; d < at_angle.length_mm.size(); ++d) {
        const double side = longer_mm(d) < 0 ? -1 : 1;
        add(LocalModel::Row::Kind::direction, d, pilot_deg,
            side * (at_angle.length_mm(d) - last.length_mm(d)) - least_mm,
            side * (at_angle.length_by_mm.row(d) - last.length_by_mm.row(d)));
      }
      last = std::move(at_angle);
    }
  }

  // Rows are the rise of the energy from angle to angle, N mm.
  void add_rises(const PathGradients::AtAngle& end, const Springs& criterion) {
    const SpringChanges springs(changes_, criterion);
    const auto energy_at = [&](const PathGradients::AtAngle& at_angle) {
      const VectorXd forces_n = springs.forces_n(at_angle);
      return std::pair(forces_n.squaredNorm() / (2 * springs.n_per_mm()),
                       springs.energy_row(at_angle, forces_n));
    };
    auto last = energy_at(flat_);
    for (const double pilot_deg : angles_of_directions(end.pilot_deg)) {
      auto at_angle = energy_at(pilot_deg == end.pilot_deg ? end : changes_.at(pilot_deg));
      model_.rows.push_back({LocalModel::Row::Kind::energy, 0, pilot_deg,
                             at_angle.first - last.first, at_angle.second - last.second});
      last = std::move(at_angle);
    }
  }

  // Rows are the diagonal's change in a degree there.
  void add_low_slopes(double to_deg) {
    std::map<double, std::optional<PathGradients::Slopes>> at_deg;
    for (const LowSlope& low : low_slopes(sheet_, to_deg)) {
      const double least = options_.least_slope_mm_per_deg, a_deg = low.pilot_deg;
      if (low.mm_per_deg >= kLowSlopes * least) continue;
      if (!at_deg.contains(a_deg)) at_deg[a_deg] = changes_.gradients.slopes(a_deg);
      const auto& slopes = at_deg[a_deg];
      if (!slopes) continue;  // the way ends there
      const double sine = std::sin(a_deg * kRadPerDeg);
      const double side = slopes->slope_mm_per_rad(low.diagonal) * low.mm_per_deg < 0 ? -1 : 1;
      add(LocalModel::Row::Kind::direction, low.diagonal, a_deg,
          (low.mm_per_deg - (1 + kAboveLeast) * least) * sine,
          side * kRadPerDeg * slopes->slope_by_mm.row(low.diagonal));
    }
  }

  void add_folds(const PathGradients::AtAngle& at_angle) {
    for (Index c = 0; c < at_angle.fold_deg.size(); ++c) {
      if (static_cast<int>(c) == sheet_.mechanism().pilot) continue;
      const double side = at_angle.fold_deg(c) < 0 ? -1 : 1;
      add(LocalModel::Row::Kind::fold_angle, c, at_angle.pilot_deg,
          180 - kBeforeFlat_deg - side * at_angle.fold_deg(c), -side * at_angle.fold_by_mm.row(c));
    }
    if (const auto limit = changes_.gradients.fold_limit()) {
      add(LocalModel::Row::Kind::fold_limit, 0, limit->fold_limit_deg,
          limit->fold_limit_deg - at_angle.pilot_deg - kBeforeLimit_deg, limit->by_mm);
    }
  }

  // Rows are for the angle where a diagonal is farthest from flat: that of use if it is monotone.
  void add_strokes(double limit) {
    const std::vector<double> angles_deg =
        angles_of_directions(angle_of_use(sheet_, options_.used_from_deg));
    VectorXd most_mm = VectorXd::Zero(flat_.length_mm.size()), lengths_mm, rates;
    std::vector<std::size_t> most_at(static_cast<std::size_t>(most_mm.size()));
    for (std::size_t k = 0; k < angles_deg.size(); ++k) {
      sheet_.way()->find_lengths(sheet_.way()->x_of(angles_deg[k]), lengths_mm, rates);
      for (Index d = 0; d < most_mm.size(); ++d) {
        const double off_mm = std::abs(lengths_mm(d) - flat_.length_mm(d));
        if (off_mm >= most_mm(d)) most_mm(d) = off_mm, most_at[static_cast<std::size_t>(d)] = k;
      }
    }
    for (const std::size_t k : std::set(most_at.begin(), most_at.end())) {
      const PathGradients::AtAngle at_angle = changes_.at(angles_deg[k]);
      for (Index d = 0; d < at_angle.length_mm.size(); ++d) {
        if (most_at[static_cast<std::size_t>(d)] == k) add_stroke(at_angle, d, limit);
      }
    }
  }

  void add_stroke(const PathGradients::AtAngle& at_angle, Index d, double limit) {
    const double longer_mm = at_angle.length_mm(d) - flat_.length_mm(d);
    const double side = longer_mm < 0 ? -1 : 1;
    add(LocalModel::Row::Kind::stroke, d, at_angle.pilot_deg,
        limit * flat_.length_mm(d) - side * longer_mm,
        limit * flat_.length_by_mm.row(d) -
            side * (at_angle.length_by_mm.row(d) - flat_.length_by_mm.row(d)));
  }

  void add_forces(double most_n) {
    assert(most_n >= 0);
    const SpringChanges springs(changes_);
    const PathGradients::AtAngle at_angle = changes_.at(*options_.deploying.from_deg);
    const VectorXd forces_n = springs.forces_n(at_angle);
    for (Index d = 0; d < forces_n.size(); ++d) {
      const double side = forces_n(d) < 0 ? -1 : 1;
      const VectorXd row = springs.forces_row(at_angle, side * VectorXd::Unit(forces_n.size(), d));
      model_.rows.push_back({LocalModel::Row::Kind::force, static_cast<int>(d), at_angle.pilot_deg,
                             most_n - side * forces_n(d), -row});
    }
  }

  // Slacks are in the unit of the floor's goal.
  void add_floors() {
    for (std::size_t floor = 0; floor < options_.floors.size(); ++floor) {
      const auto& [goal, least] = options_.floors[floor];
      if (!goal->is_exact) continue;  // each sheet is checked instead
      const double kept = goal->is_to_be_small ? (1 - kWithinBound) * least : least;
      for (const GoalTerm& term : linearization_of(*goal, changes_)) {
        model_.rows.push_back({LocalModel::Row::Kind::floor, static_cast<int>(floor), 0,
                               term.numerator / term.divisor - kept, term.row / term.divisor});
      }
    }
  }

  const Sheet& sheet_;
  const OptimiseOptions& options_;
  SheetChanges changes_;
  const PathGradients::AtAngle& flat_;
  LocalModel model_;
};

}  // namespace

double LocalModel::goal(const VectorXd& change_mm) const {
  double least = std::numeric_limits<double>::infinity();
  for (const GoalTerm& term : goals) {
    least = std::min(least, (term.numerator + term.row.dot(change_mm)) / term.divisor);
  }
  return least;
}

std::optional<LocalModel> local_model(const Sheet& sheet, const OptimiseOptions& options) {
  assert(options.deploying.from_deg);
  if (!sheet.way() || sheet.model().is_overconstrained()) return {};
  return Builder(sheet, options).build();
}

}  // namespace misalign::solver
