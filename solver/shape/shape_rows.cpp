#include "solver/shape/shape_rows.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

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
  Builder(const Sheet& sheet, const ShapeOptions& options, const WantedDirections& wanted,
          PathGradients* gradients)
      : sheet_(sheet), options_(options), wanted_(wanted), gradients_(gradients) {}

  std::optional<std::vector<ShapeRow>> build() {
    add_corners();
    add_edges();
    add_folds();
    add_limit();
    if (wanted_.sides.size() > 0) add_directions();
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
    const double asked_deg = options_.kind == ShapeKind::free ? options_.at_deg : options_.from_deg;
    RowVectorXd row;
    if (gradients_) {
      const auto limit = gradients_->fold_limit();
      if (!limit) return;
      row = mm_per_deg * limit->by_mm;
    }
    rows_.push_back({ShapeRow::Kind::limit, 0, way.end_deg(),
                     mm_per_deg * (way.end_deg() - asked_deg - options_.beyond_deg),
                     std::move(row)});
  }

  void add_directions() {
    const FoldingWay& way = *sheet_.way();
    assert(wanted_.sides.size() == way.flat_mm().size());
    VectorXd last_mm = way.flat_mm(), lengths_mm, rates;
    Eigen::MatrixXd last_by_mm;
    if (gradients_) last_by_mm = gradients_->at(0, false)->length_by_mm;
    double last_deg = 0;
    for (const double angle_deg : wanted_.angles_deg) {
      if (angle_deg >= way.end_deg() - 0.01) break;
      Eigen::MatrixXd by_mm;
      if (gradients_) {
        auto there = gradients_->at(angle_deg, false);
        if (!there) return void(is_known_ = false);
        lengths_mm = there->length_mm;
        by_mm = std::move(there->length_by_mm);
      } else {
        way.find_lengths(way.x_of(angle_deg), lengths_mm, rates);
      }
      const double least_mm = options_.least_slope_mm_per_deg / kRadPerDeg *
                              (std::cos(last_deg * kRadPerDeg) - std::cos(angle_deg * kRadPerDeg));
      for (Index d = 0; d < lengths_mm.size(); ++d) {
        const double side = wanted_.sides(d);
        RowVectorXd row;
        if (gradients_) row = side * (by_mm.row(d) - last_by_mm.row(d));
        rows_.push_back({ShapeRow::Kind::direction, static_cast<int>(d), angle_deg,
                         side * (lengths_mm(d) - last_mm(d)) - least_mm, std::move(row)});
      }
      last_mm = lengths_mm;
      last_by_mm = std::move(by_mm);
      last_deg = angle_deg;
    }
  }

  const Sheet& sheet_;
  const ShapeOptions& options_;
  const WantedDirections& wanted_;
  PathGradients* const gradients_;
  bool is_known_ = true;
  std::vector<ShapeRow> rows_;
};

}  // namespace

std::optional<std::vector<ShapeRow>> shape_rows(const Sheet& sheet, const ShapeOptions& options,
                                                const WantedDirections& wanted,
                                                PathGradients* gradients) {
  assert(sheet.way() && sheet.way()->end_deg() > options.at_deg);
  return Builder(sheet, options, wanted, gradients).build();
}

}  // namespace misalign::solver
