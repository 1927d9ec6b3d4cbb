#include "solver/shape/shape_rows.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/local_goals.hpp"
#include "solver/shape/diagonal_lengths.hpp"
#include "solver/shape/well_rows.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Rows this far from their limits do not bind in any step: sine of a corner, share of an edge.
constexpr double kFarSine = 0.3, kFarEdge = 0.3;

class Builder {
 public:
  Builder(const Sheet& sheet, const ShapeOptions& options, const WantedRows& wanted,
          PathGradients* gradients)
      : sheet_(sheet), options_(options), wanted_(wanted), gradients_(gradients) {}

  std::optional<std::vector<ShapeRow>> build() {
    add_corners();
    add_edges();
    add_folds();
    add_limit();
    if (wanted_.sides.size() > 0) add_directions();
    if (wanted_.has_wells) {
      is_known_ = is_known_ &&
                  (options_.kind == ShapeKind::bistable
                       ? add_bistable_rows(sheet_, options_, gradients_, rows_)
                       : add_energy_rows(sheet_, options_, wanted_.angles_deg, gradients_, rows_));
    }
    add_floors();
    if (!is_known_) return {};
    return std::move(rows_);
  }

 private:
  double width_mm() const { return sheet_.mechanism().panel_width_mm; }
  RowVectorXd zero() const { return RowVectorXd::Zero(2 * sheet_.vertices_mm().cols()); }

  // The sine of a corner is the product of its edges' directions.
  void add_corners() {
    const CreasePattern& pattern = sheet_.base().sheet;
    for (std::size_t f = 0; f < pattern.facets.size(); ++f) {
      const std::array<int, 4>& facet = pattern.facets[f];
      for (std::size_t k = 0; k < 4; ++k) {
        const int at = facet[k], next = facet[(k + 1) % 4], last = facet[(k + 3) % 4];
        const Vector2d a = sheet_.point_mm(next) - sheet_.point_mm(at),
                       b = sheet_.point_mm(last) - sheet_.point_mm(at);
        const double lengths = a.norm() * b.norm(),
                     sine = (a.x() * b.y() - a.y() * b.x()) / lengths;
        if (sine > options_.least_sine + kFarSine) continue;
        RowVectorXd row;
        if (gradients_) {
          row = zero();
          const Vector2d by_a = Vector2d(b.y(), -b.x()) / lengths - sine / a.squaredNorm() * a,
                         by_b = Vector2d(-a.y(), a.x()) / lengths - sine / b.squaredNorm() * b;
          row.segment<2>(2 * next) = width_mm() * by_a.transpose();
          row.segment<2>(2 * last) = width_mm() * by_b.transpose();
          row.segment<2>(2 * at) = -width_mm() * (by_a + by_b).transpose();
        }
        rows_.push_back({ShapeRow::Kind::corner, static_cast<int>(f), 0,
                         width_mm() * (sine - options_.least_sine), std::move(row)});
      }
    }
  }

  void add_edges() {
    const CreasePattern& pattern = sheet_.base().sheet;
    for (std::size_t e = 0; e < pattern.edges.size(); ++e) {
      const auto [a, b, left, right] = pattern.edges[e];
      const double base_mm = (pattern.vertices_mm.col(b) - pattern.vertices_mm.col(a)).norm();
      const Vector2d along = sheet_.point_mm(b) - sheet_.point_mm(a);
      const double length_mm = along.norm();
      if (length_mm > (options_.least_edge + kFarEdge) * base_mm) continue;
      RowVectorXd row;
      if (gradients_) {
        row = zero();
        row.segment<2>(2 * b) = along.transpose() / length_mm;
        row.segment<2>(2 * a) = -along.transpose() / length_mm;
      }
      rows_.push_back({ShapeRow::Kind::edge, static_cast<int>(e), 0,
                       length_mm - options_.least_edge * base_mm, std::move(row)});
    }
  }

  // Fold angles as arcs of a panel's width.
  void add_folds() {
    const Sheet::Pose& pose = sheet_.at(options_.at_deg);
    std::optional<PathGradients::AtAngle> there;
    if (gradients_) there = gradients_->at(options_.at_deg);
    if (gradients_ && !there) return void(is_known_ = false);
    const Mechanism& mechanism = sheet_.mechanism();
    const double mm_per_deg = kRadPerDeg * width_mm();
    for (Index c = 0; c < pose.fold_deg.size(); ++c) {
      if (static_cast<int>(c) == mechanism.pilot) continue;
      const double side =
          mechanism.is_valley(mechanism.creases[static_cast<std::size_t>(c)]) ? 1 : -1;
      const double fold_deg = side * pose.fold_deg(c);
      const auto add = [&](double slack_deg, double sign) {
        RowVectorXd row;
        if (there) row = sign * side * mm_per_deg * there->fold_by_mm.row(c);
        rows_.push_back({ShapeRow::Kind::fold, static_cast<int>(c), options_.at_deg,
                         mm_per_deg * slack_deg, std::move(row)});
      };
      add(fold_deg - options_.least_fold_deg, 1);
      add(options_.most_fold_deg - fold_deg, -1);
    }
  }

  void add_limit() {
    const FoldingWay& way = *sheet_.way();
    if (!way.ends_at_limit()) return;
    const double mm_per_deg = kRadPerDeg * width_mm();
    RowVectorXd row;
    if (gradients_) {
      const auto limit = gradients_->fold_limit();
      if (!limit) return;
      row = mm_per_deg * limit->by_mm;
    }
    rows_.push_back({ShapeRow::Kind::limit, 0, way.end_deg(),
                     mm_per_deg * (way.end_deg() - wanted_.limit_deg), std::move(row)});
  }

  void add_directions() {
    const double end_deg = sheet_.way()->end_deg();
    auto last = diagonal_lengths(sheet_, 0, gradients_);
    double last_deg = 0;
    for (const double angle_deg : wanted_.angles_deg) {
      if (angle_deg >= end_deg - 0.01) break;
      auto there = diagonal_lengths(sheet_, angle_deg, gradients_);
      if (!last || !there) return void(is_known_ = false);
      const double least_mm =
          change_by_slope_mm(options_.least_slope_mm_per_deg, last_deg, angle_deg);
      assert(wanted_.sides.size() == there->mm.size());
      for (Index d = 0; d < there->mm.size(); ++d) {
        const double side = wanted_.sides(d);
        RowVectorXd row;
        if (gradients_) row = side * (there->by_mm.row(d) - last->by_mm.row(d));
        rows_.push_back({ShapeRow::Kind::direction, static_cast<int>(d), angle_deg,
                         side * (there->mm(d) - last->mm(d)) - least_mm, std::move(row)});
      }
      last = std::move(there);
      last_deg = angle_deg;
    }
  }

  // Terms below their floor share its price.
  void add_floors() {
    for (std::size_t k = 0; k < wanted_.floors.size(); ++k) {
      const double least = wanted_.floors[k].least, mm = wanted_.floors[k].mm;
      const Goal& goal = *options_.keeping.floors[k].goal;
      const auto add = [&](double value, double share_mm, const RowVectorXd& row) {
        rows_.push_back({ShapeRow::Kind::floor, static_cast<int>(k), 0, share_mm * (value - least),
                         share_mm * row});
      };
      if (!gradients_) {
        const auto value = value_of(goal, sheet_, options_.keeping);
        if (!value) return void(is_known_ = false);
        add(*value, mm, {});
        continue;
      }
      SheetChanges changes(sheet_, options_.keeping);
      const std::vector<GoalTerm> terms = linearization_of(goal, changes);
      if (terms.empty() || !changes.is_known) return void(is_known_ = false);
      const auto below = std::ranges::count_if(
          terms, [&](const GoalTerm& term) { return term.numerator < least * term.divisor; });
      const double share_mm = mm / static_cast<double>(std::max<std::ptrdiff_t>(1, below));
      for (const GoalTerm& term : terms) {
        add(term.numerator / term.divisor, share_mm, term.row.transpose() / term.divisor);
      }
    }
  }

  const Sheet& sheet_;
  const ShapeOptions& options_;
  const WantedRows& wanted_;
  PathGradients* const gradients_;
  bool is_known_ = true;
  std::vector<ShapeRow> rows_;
};

}  // namespace

std::optional<std::vector<WantedRows::Level>> floor_levels(const Sheet& sheet,
                                                           const ShapeOptions& options,
                                                           double raise) {
  std::vector<WantedRows::Level> levels;
  for (const OptimiseFloor& floor : options.keeping.floors) {
    const auto value = value_of(*floor.goal, sheet, options.keeping);
    SheetChanges changes(sheet, options.keeping);
    double steepest = 0;
    for (const GoalTerm& term : linearization_of(*floor.goal, changes)) {
      steepest = std::max(steepest, term.row.norm() / term.divisor);
    }
    if (!value || steepest == 0 || !changes.is_known) return {};
    const double reached = raise * *value;
    levels.push_back({*value > 0 ? std::min(floor.least, reached) : floor.least, 1 / steepest});
  }
  return levels;
}

std::optional<std::vector<ShapeRow>> shape_rows(const Sheet& sheet, const ShapeOptions& options,
                                                const WantedRows& wanted,
                                                PathGradients* gradients) {
  assert(sheet.way() && sheet.way()->end_deg() > options.at_deg);
  return Builder(sheet, options, wanted, gradients).build();
}

}  // namespace misalign::solver
