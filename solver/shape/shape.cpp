#include "solver/shape/shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/optimise/low_slopes.hpp"
#include "solver/shape/shape_merit.hpp"

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
// The first curvature and the largest growth between stages, times the sheet's width.
constexpr double kFirstCurvature = 0.1, kCurvatureStep = 1.0 / 12;
// Angle by whose lengths directions are chosen; angles of directions; distance of more from one
// where a diagonal turns back; rounds of these.
constexpr double kSigns_deg = 60, kDirections_deg = 9, kAround_deg = 1.5;
constexpr int kRounds = 3;

class Shaping {
 public:
  Shaping(SheetSolver& solver, const ShapeOptions& options)
      : solver_(solver),
        options_(options),
        base_(solver.model().base().sheet),
        width_mm_(base_.panel_width_mm),
        size_mm_(width_mm_ * std::sqrt(static_cast<double>(base_.facet_count()))),
        free_(options.is_rim_fixed ? interior_vertices(base_) : all_vertices(base_)),
        merit_(base_, free_) {}

  StudyResult<ShapeStudy> run() {
    if (!begin()) return NoResult::path_lost;
    climb_in_curvature();
    if (options_.kind == ShapeKind::rest) keep_directions();
    return result();
  }

 private:
  struct State {
    std::unique_ptr<const Sheet> sheet;
    ShapePose pose;
    ShapeMisfit misfit;
    double merit;
  };

  bool begin() {
    const Matrix2Xd none = Matrix2Xd::Zero(2, base_.vertex_count());
    auto sheet = std::make_unique<const Sheet>(solver_, none);
    if (!sheet->way() || sheet->way()->end_deg() <= options_.at_deg) return false;
    const Eigen::Matrix3Xd& folded_mm = sheet->at(options_.at_deg).vertices_mm;
    const ShapePose pose =
        lay_base(base_.vertices_mm, folded_mm, interior_vertices(base_), target_);
    auto start = evaluate(none, pose);
    if (!start) return false;
    now_ = std::move(*start);
    return true;
  }

  void climb_in_curvature() {
    const double whole = options_.target->curvature_per_mm() * size_mm_;
    for (double share = std::min(1.0, kFirstCurvature / whole); whole > 0;
         share = std::min(1.0, share + kCurvatureStep / whole)) {
      target_.surface = options_.target->scaled(share);
      refresh();
      improve();
      if (share == 1) break;
    }
  }

  // Directions are those of the shape alone, by the lengths at one angle; of two diagonals of a
  // hole that both grow the smaller is turned. The better of two choices of the angle stays.
  void keep_directions() {
    const Matrix2Xd shape_mm = now_.sheet->shifts_mm();
    const ShapePose shape_pose = now_.pose;
    const double end_deg = std::min(now_.sheet->way()->end_deg() - 1, options_.from_deg);
    std::optional<State> best;
    WantedDirections best_wanted;
    for (const double by_deg : {std::min(kSigns_deg, end_deg), end_deg}) {
      wanted_ = {};
      auto again = evaluate(shape_mm, shape_pose);
      if (!again) continue;
      now_ = std::move(*again);
      choose_directions(by_deg);
      for (int round = 0; round < kRounds; ++round) {
        refresh();
        improve();
        if (!add_angles()) break;
      }
      if (best && best->merit <= now_.merit) continue;
      best = std::move(now_);
      best_wanted = wanted_;
    }
    if (!best) return;
    now_ = std::move(*best);
    wanted_ = best_wanted;
  }

  void choose_directions(double by_deg) {
    const FoldingWay& way = *now_.sheet->way();
    VectorXd lengths_mm, rates;
    way.find_lengths(way.x_of(by_deg), lengths_mm, rates);
    const VectorXd longer_mm = lengths_mm - way.flat_mm();
    wanted_.sides = longer_mm.unaryExpr([](double mm) { return mm < 0 ? -1.0 : 1.0; });
    for (Index d = 0; d + 1 < longer_mm.size(); d += 2) {
      if (wanted_.sides(d) < 0 || wanted_.sides(d + 1) < 0) continue;
      wanted_.sides(longer_mm(d) < longer_mm(d + 1) ? d : d + 1) = -1;
    }
    wanted_.angles_deg.clear();
    const int count = static_cast<int>(std::ceil(options_.from_deg / kDirections_deg));
    for (int k = 1; k <= count; ++k) wanted_.angles_deg.push_back(options_.from_deg * k / count);
  }

  // Adds angles around those where a diagonal turns back. Returns false where none does.
  bool add_angles() {
    const double to_deg = std::min(options_.from_deg, now_.sheet->way()->end_deg());
    std::vector<double> more_deg;
    for (const LowSlope& low : low_slopes(*now_.sheet, to_deg)) {
      if (low.mm_per_deg > 0) continue;
      for (const double off_deg : {-kAround_deg, kAround_deg}) {
        const double angle_deg = std::clamp(low.pilot_deg + off_deg, 1.0, options_.from_deg);
        more_deg.push_back(std::round(angle_deg));
      }
    }
    const std::size_t before = wanted_.angles_deg.size();
    std::vector<double>& all_deg = wanted_.angles_deg;
    for (const double angle_deg : more_deg) {
      const auto is_near = [&](double other) { return std::abs(other - angle_deg) < 0.9; };
      if (std::ranges::none_of(all_deg, is_near)) all_deg.push_back(angle_deg);
    }
    std::ranges::sort(all_deg);
    return all_deg.size() > before;
  }

  std::optional<State> evaluate(const Matrix2Xd& shifts_mm, const ShapePose& near) {
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

  // The same sheet by other rows or another target.
  void refresh() {
    auto again = evaluate(now_.sheet->shifts_mm(), now_.pose);
    if (again) now_ = std::move(*again);
  }

  void improve() {
    double box_mm = kFirstBox * width_mm_;
    for (int step = 0; step < kStageSteps; ++step) {
      PathGradients gradients(*now_.sheet);
      const auto folded = gradients.vertices(options_.at_deg);
      const auto rows = shape_rows(*now_.sheet, options_, wanted_, &gradients);
      if (!folded || !rows) return;
      const QuadraticProgram program = merit_.program(now_.misfit, *folded, *now_.sheet, *rows);
      while (true) {
        if (box_mm < kLastBox * width_mm_) return;
        const auto [change_mm, foreseen] = best_change(program, box_mm);
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

  // The best change of the shifts in a box, and the foreseen gain of the merit.
  std::pair<Matrix2Xd, double> best_change(const QuadraticProgram& around, double box_mm) const {
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
    // Rows that the box does not reach.
    std::vector<Index> reached;
    for (Index k = 0; k < inside.slacks.size(); ++k) {
      if (inside.slacks(k) < box_mm * inside.rows.row(k).lpNorm<1>()) reached.push_back(k);
    }
    const MatrixXd rows = inside.rows(reached, Eigen::all);
    inside.rows = rows;
    const VectorXd slacks = inside.slacks(reached);
    inside.slacks = slacks;
    const QuadraticOptimum best = minimize(inside);
    Matrix2Xd change_mm = Matrix2Xd::Zero(2, base_.vertex_count());
    for (Index k = 0; k < shifts; ++k) {
      change_mm(k % 2, free_[static_cast<std::size_t>(k / 2)]) = best.x(k);
    }
    const double now = inside.penalty * (-inside.slacks.array()).max(0).sum();
    return {change_mm, now - best.value};
  }

  ShapeStudy result() const {
    ShapeStudy study;
    study.shifts_mm = now_.sheet->shifts_mm();
    study.pose = now_.pose;
    study.sides = target_.sides;
    study.rms_mm = now_.misfit.rms_mm();
    study.max_mm = now_.misfit.max_mm();
    study.steps = steps_;
    study.evaluations = evaluations_;
    study.deploys_from_deg = now_.sheet->deploys_from_deg();
    return study;
  }

  SheetSolver& solver_;
  const ShapeOptions& options_;
  const CreasePattern& base_;
  const double width_mm_, size_mm_;
  const std::vector<int> free_;
  const ShapeMerit merit_;
  ShapeTarget target_;  // with its curvature of now
  WantedDirections wanted_;
  State now_;
  int steps_ = 0, evaluations_ = 0;
};

}  // namespace

StudyResult<ShapeStudy> shape(SheetSolver& solver, const ShapeOptions& options) {
  assert(options.target && options.at_deg > 0 && options.from_deg > options.at_deg);
  if (solver.model().is_overconstrained()) return NoResult::overconstrained;
  return Shaping(solver, options).run();
}

}  // namespace misalign::solver
