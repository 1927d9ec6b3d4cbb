#include "solver/shape/shape_descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The box in panel widths: the first, the largest and the least; its growth and its decline.
constexpr double kFirstBox = 0.05, kLargestBox = 0.25, kLastBox = 1e-6, kGrow = 1.8, kShrink = 0.4;
constexpr double kRight = 0.7, kPoor = 0.1;
// Gain, as a share of the merit, below which a stage ends; steps of a stage.
constexpr double kLastGain = 5e-4;
constexpr int kStageSteps = 80;
// Curvature of an arc over its chord: its rise times this, by its chord squared.
constexpr double kArc = 8;
// Number of limits that are told, and the box in panel widths in which their prices are found.
constexpr std::size_t kMostLimits = 8;
constexpr double kPriceBox = 0.01;
// Shifts this near to the amplitude, as a share of it, are held by it.
constexpr double kAtAmplitude = 1e-4;
// Prices and violations below these are rounding.
constexpr double kLeastPrice = 1e-3, kLeastMissing = 1e-3, kLeastMerit = 1e-12;

}  // namespace

ShapeDescent::ShapeDescent(SheetSolver& solver, const ShapeOptions& options)
    : solver_(solver),
      options_(options),
      base_(solver.model().base().sheet),
      width_mm_(base_.panel_width_mm),
      size_mm_(width_mm_ * std::sqrt(static_cast<double>(base_.facet_count()))),
      free_(options.is_rim_fixed ? interior_vertices(base_) : all_vertices(base_)),
      merit_(base_, free_, start_mm(), options.shift_weight) {}

Matrix2Xd ShapeDescent::start_mm() const {
  return options_.start_mm.value_or(Matrix2Xd::Zero(2, base_.vertex_count()));
}

bool ShapeDescent::begin(const WantedRows& wanted) {
  wanted_ = wanted;
  const Matrix2Xd none = Matrix2Xd::Zero(2, base_.vertex_count());
  auto sheet = std::make_unique<const Sheet>(solver_, none);
  if (!sheet->way() || sheet->way()->end_deg() <= options_.at_deg) return false;
  const Eigen::Matrix3Xd& folded_mm = sheet->at(options_.at_deg).vertices_mm;
  static_cast<WantedShape&>(target_) = options_.target;
  const ShapePose pose = lay_base(solver_.model().base(), folded_mm, target_);
  for (WantedShape::Place& place : target_.places) {
    place.mm = pose.turn * folded_mm.col(place.vertex) + pose.move_mm;
  }
  from_places_ = target_.places;
  return move_to(start_mm(), pose);
}

double ShapeDescent::whole_curvature() const {
  if (target_.surface) return options_.target.surface->curvature_per_mm() * size_mm_;
  double off_mm = 0;
  for (std::size_t k = 0; k < from_places_.size(); ++k) {
    off_mm = std::max(off_mm, (options_.target.places[k].mm - from_places_[k].mm).norm());
  }
  return kArc * off_mm / size_mm_;
}

void ShapeDescent::set_share(double share) {
  if (target_.surface) {
    target_.surface = options_.target.surface->scaled(share);
  }
  for (std::size_t k = 0; k < from_places_.size(); ++k) {
    target_.places[k].mm =
        from_places_[k].mm + share * (options_.target.places[k].mm - from_places_[k].mm);
  }
}

std::optional<ShapeDescent::State> ShapeDescent::evaluate(const Matrix2Xd& shifts_mm,
                                                          const ShapePose& near) {
  options_.watch();
  ++evaluations_;
  auto sheet = std::make_unique<const Sheet>(solver_, shifts_mm);
  if (!nonconvex_facets(base_, sheet->vertices_mm()).empty()) return {};
  if (!sheet->way() || sheet->way()->end_deg() <= options_.at_deg) return {};
  const Sheet::Pose& pose = sheet->at(options_.at_deg);
  if (!pose.is_closed) return {};
  const ShapePose fitted = fitted_pose(target_, pose.vertices_mm, near);
  ShapeMisfit off = misfit(target_, pose.vertices_mm, fitted);
  const auto rows = shape_rows(*sheet, options_, wanted_, nullptr);
  if (!rows) return {};
  const double merit = merit_.value(off, shifts_mm, *rows);
  return State{std::move(sheet), fitted, std::move(off), merit};
}

void ShapeDescent::refresh() {
  auto again = evaluate(now_.sheet->shifts_mm(), now_.pose);
  if (again) now_ = std::move(*again);
}

void ShapeDescent::improve() {
  double box_mm = kFirstBox * width_mm_;
  for (int step = 0; step < kStageSteps; ++step) {
    std::vector<ShapeRow> rows;
    const auto around = program(rows);
    if (!around) return;
    while (true) {
      if (box_mm < kLastBox * width_mm_) return;
      const auto [change_mm, foreseen] = best_change(*around, box_mm);
      if (foreseen <= kLastGain * now_.merit) return;
      auto next = evaluate(now_.sheet->shifts_mm() + change_mm, now_.pose);
      const double gain = next ? now_.merit - next->merit : -1;
      if (gain < kPoor * foreseen) {
        box_mm *= kShrink;
        if (gain <= 0) continue;
      } else if (gain > kRight * foreseen) {
        box_mm = std::min(kGrow * box_mm, kLargestBox * width_mm_);
      }
      now_ = std::move(*next);
      ++steps_;
      break;
    }
  }
}

bool ShapeDescent::move_to(const Matrix2Xd& shifts_mm, const ShapePose& near) {
  auto there = evaluate(shifts_mm, near);
  if (!there) return false;
  now_ = *std::move(there);
  return true;
}

std::optional<QuadraticProgram> ShapeDescent::program(std::vector<ShapeRow>& rows) const {
  PathGradients gradients(*now_.sheet);
  const auto folded = gradients.vertices(options_.at_deg);
  auto found = shape_rows(*now_.sheet, options_, wanted_, &gradients);
  if (!folded || !found) return {};
  rows = *std::move(found);
  return merit_.program(now_.misfit, target_.weights, *folded, *now_.sheet, rows);
}

// The program in a box, with the rows that it reaches.
QuadraticProgram ShapeDescent::in_box(const QuadraticProgram& around, double box_mm,
                                      std::vector<Index>& reached) const {
  const Index count = around.gradient.size(), shifts = count - 7;
  QuadraticProgram inside = around;
  inside.fall = inside.rise = Eigen::ArrayXd::Constant(count, box_mm);
  inside.fall.tail(7) = inside.rise.tail(7) = size_mm_ / 4;
  if (options_.amplitude_mm) {
    for (Index k = 0; k < shifts; ++k) {
      const double shift_mm =
          now_.sheet->shifts_mm()(k % 2, free_[static_cast<std::size_t>(k / 2)]);
      inside.rise(k) = std::clamp(*options_.amplitude_mm - shift_mm, 0.0, box_mm);
      inside.fall(k) = std::clamp(*options_.amplitude_mm + shift_mm, 0.0, box_mm);
    }
  }
  for (Index k = 0; k < around.slacks.size(); ++k) {
    if (around.slacks(k) < box_mm * around.rows.row(k).lpNorm<1>()) reached.push_back(k);
  }
  inside.rows = around.rows(reached, Eigen::all);
  inside.slacks = around.slacks(reached);
  return inside;
}

// The best change of the shifts in a box, and the foreseen gain of the merit.
std::pair<Matrix2Xd, double> ShapeDescent::best_change(const QuadraticProgram& around,
                                                       double box_mm) const {
  std::vector<Index> reached;
  const QuadraticProgram inside = in_box(around, box_mm, reached);
  const QuadraticOptimum best = minimize(inside);
  Matrix2Xd change_mm = Matrix2Xd::Zero(2, base_.vertex_count());
  for (Index k = 0; k < 2 * std::ssize(free_); ++k) {
    change_mm(k % 2, free_[static_cast<std::size_t>(k / 2)]) = best.x(k);
  }
  const double now = inside.penalty * (-inside.slacks.array()).max(0).sum();
  return {change_mm, now - best.value};
}

// Fall of the merit, to first order, per mm of all amplitudes: of coordinates at theirs the slope
// of the program's Lagrange function.
double ShapeDescent::price_of_amplitude(const QuadraticProgram& program,
                                        const QuadraticOptimum& best) const {
  if (!options_.amplitude_mm) return 0;
  const VectorXd slope =
      program.hessian * best.x + program.gradient - program.rows.transpose() * best.price;
  double price = 0;
  for (Index k = 0; k < 2 * std::ssize(free_); ++k) {
    const double shift_mm =
        now_.sheet->shifts_mm()(k % 2, free_[static_cast<std::size_t>(k / 2)]) + best.x(k);
    const double room_mm = *options_.amplitude_mm - std::abs(shift_mm);
    if (room_mm < kAtAmplitude * *options_.amplitude_mm) price += std::abs(slope(k));
  }
  return price;
}

std::vector<ShapeLimit> ShapeDescent::limits() const {
  std::vector<ShapeRow> rows;
  const auto around = program(rows);
  if (!around) return {};
  std::vector<Index> reached;
  const QuadraticProgram inside = in_box(*around, kPriceBox * width_mm_, reached);
  const QuadraticOptimum best = minimize(inside);
  const double merit = std::max(now_.merit, kLeastMerit);
  std::vector<ShapeLimit> limits;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const ShapeRow& row = rows[static_cast<std::size_t>(reached[k])];
    const bool is_angle = row.kind == ShapeRow::Kind::fold || row.kind == ShapeRow::Kind::limit;
    const double unit_mm = is_angle ? kRadPerDeg * width_mm_
                           : row.kind == ShapeRow::Kind::floor
                               ? wanted_.floors[static_cast<std::size_t>(row.where)].mm
                           : row.kind == ShapeRow::Kind::corner ? width_mm_
                                                                : 1;
    const double price = best.price(static_cast<Index>(k)) * unit_mm / merit;
    const double missing = -row.slack / unit_mm;
    const bool is_missed = missing > kLeastMissing;
    if (price > kLeastPrice || is_missed) {
      limits.push_back({row.kind, row.where, row.pilot_deg, is_missed ? missing : 0, price});
    }
  }
  const double price = price_of_amplitude(inside, best) / merit;
  if (price > kLeastPrice) limits.push_back({ShapeRow::Kind::amplitude, -1, 0, 0, price});
  std::ranges::sort(limits, std::greater(), [](const ShapeLimit& limit) {
    return std::pair(limit.missing > 0, limit.price);
  });
  if (limits.size() > kMostLimits) limits.resize(kMostLimits);
  return limits;
}

}  // namespace misalign::solver
