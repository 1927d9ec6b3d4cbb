#include "solver/optimise/ascent.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/optimise/local_program.hpp"
#include "solver/optimise/objective.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::VectorXd;

// The box of a linear program, in amplitudes: the first, and the least; this of sheets with a
// shape, whose shifts are as large as distances from it are small.
constexpr double kFirstBox = 0.25, kLastBox = 1e-3, kLastBoxOfShape = 2e-5;
// Least gain of a step, as a share of the goal.
constexpr double kLeastGain = 1e-4;
// The box grows where at least this share of the foreseen gain came true.
constexpr double kForeseen = 0.5;
// Box, in amplitudes, in which the limits at the optimum are found.
constexpr double kBoxOfLimits = 0.05;
// A flip is evaluated even if it seems to violate a row by this share of its effect: to first order
// slopes are off by 7 % at 120 degrees, and by half at 150.
constexpr double kEarlyDoubt = 0.15, kLateDoubt = 0.6, kLateFrom_deg = 120;

}  // namespace

Ascent::Ascent(const Sheet& start, Optimised fitted)
    : options_(fitted.options),
      variables_(options_),
      solver_(start.model()),
      box_mm_(kFirstBox * options_.amplitude_mm),
      now_{std::make_unique<const Sheet>(solver_, start.shifts_mm()), fitted.best(),
           fitted.best().value},
      result_(std::move(fitted)) {}

void Ascent::advance() {
  assert(!finished_);
  options_.watch();
  if (!linearization_) {
    begin_step();
  } else if (trying_ == Trying::in_a_box) {
    try_box();
  } else {
    try_flip();
  }
}

void Ascent::begin_step() {
  if (result_.steps() >= options_.most_steps) return end(Optimised::StopReason::most_steps);
  if (now_.value >= options_.goal->largest) return end(Optimised::StopReason::no_step_is_better);
  linearization_ = local_model(*now_.sheet, options_);
  if (!linearization_) return end(Optimised::StopReason::no_step_is_better);
  trying_ = Trying::in_a_box;
  if (options_.ternary) begin_flips();
}

void Ascent::end(Optimised::StopReason why) {
  result_.stop_reason = why;
  finished_ = true;
  if (linearization_ && !options_.ternary && options_.goal->is_exact) find_limits();
}

void Ascent::take_step(Feasible next) {
  assert(next.value > now_.value && "each step does better");
  now_ = std::move(next);
  set_springs(options_, now_.point);
  result_.taken.push_back({now_.point, now_.value});
  options_.see_steps(result_.steps());
  linearization_.reset();
}

// Takes a step of free shifts: the box shrinks until its linearisation is right.
void Ascent::try_box() {
  assert(linearization_ && box_mm_ > 0);
  const double last_box = options_.shape ? kLastBoxOfShape : kLastBox;
  if (box_mm_ < std::max(last_box * options_.amplitude_mm, options_.grid_mm / 2)) {
    return give_up_box();
  }
  const LocalProgram inside = local_program(*linearization_, box_mm_);
  const LinearOptimum best = maximize(inside.linear);
  const double foreseen = best.value * inside.unit;
  if (best.end != LinearOptimum::StopReason::optimal || foreseen <= least_foreseen())
    return give_up_box();
  auto next = evaluate(inside.change_mm(best));
  const double gained = next ? next->value - now_.value : 0;
  if (gained > (options_.goal->is_exact ? kForeseen * foreseen : least_gain())) {
    box_mm_ = std::min(2 * box_mm_, options_.amplitude_mm);
    return take_step(std::move(*next));
  }
  box_mm_ /= 2;
  if (gained > least_gain()) take_step(std::move(*next));
}

void Ascent::give_up_box() {
  box_mm_ = kFirstBox * options_.amplitude_mm;
  if (variables_.are_free() || !options_.tries_flips)
    return end(Optimised::StopReason::no_step_is_better);
  begin_flips();
}

// Evaluates flips of one or two coordinates in the order of their foreseen gain; where none is
// better, every single flip before the step is given up.
void Ascent::begin_flips() {
  trying_ = Trying::promising_flips;
  next_flip_ = 0;
  evaluations_of_step_ = 0;
  singles_ = single_flips();
  promising_.clear();
  const double own_goal = linearization_->goal(VectorXd::Zero(linearization_->coordinates));
  const auto consider = [&](Flip flip) {
    flip.foreseen = goal_after(flip) - own_goal;
    if (flip.foreseen > least_foreseen()) promising_.push_back(flip);
  };
  for (std::size_t i = 0; i < singles_.size(); ++i) {
    consider(singles_[i]);
    for (std::size_t k = i + 1; k < singles_.size(); ++k) {
      const Index first = singles_[i].coordinate[0], second = singles_[k].coordinate[0];
      if (first == second) continue;
      consider({{first, second}, {singles_[i].by_mm[0], singles_[k].by_mm[0]}});
    }
  }
  std::ranges::stable_sort(promising_, std::ranges::greater(), &Flip::foreseen);
}

// The first flip that raises the goal is a step.
void Ascent::try_flip() {
  const bool by_promise = trying_ == Trying::promising_flips;
  std::vector<Flip>& flips = by_promise ? promising_ : singles_;
  while (by_promise && next_flip_ < flips.size() && !may_fit(flips[next_flip_])) ++next_flip_;
  if (next_flip_ == flips.size() ||
      (by_promise && evaluations_of_step_ == options_.most_evaluations)) {
    if (!by_promise) return end(Optimised::StopReason::no_step_is_better);
    trying_ = Trying::single_flips;
    next_flip_ = 0;
    return;
  }
  const Flip& flip = flips[next_flip_++];
  ++evaluations_of_step_;
  VectorXd change_mm = VectorXd::Zero(linearization_->coordinates);
  for (const int k : {0, 1}) change_mm(flip.coordinate[k]) += flip.by_mm[k];
  auto next = evaluate(change_mm);
  if (next && next->value > now_.value * (1 + std::copysign(kLeastGain, now_.value)))
    take_step(std::move(*next));
}

std::optional<Ascent::Feasible> Ascent::evaluate(const VectorXd& change_mm) {
  DesignPoint point = variables_.after(now_.point, change_mm);
  auto sheet = std::make_unique<const Sheet>(solver_, point.shifts_mm);
  ++result_.evaluations;
  OptimiseOptions there = options_;
  set_springs(there, point);
  const std::optional<double> value = objective(*sheet, there);
  if (!value || !keeps_slope(*sheet, *now_.sheet, options_)) return {};
  return Feasible{std::move(sheet), std::move(point), *value};
}

// Least foreseen gain that is tried; any, where the terms only lead to the goal.
double Ascent::least_foreseen() const { return options_.goal->is_exact ? least_gain() : 0; }

double Ascent::least_gain() const { return kLeastGain * std::abs(now_.value); }

double Ascent::goal_after(const Flip& flip) const {
  assert(linearization_ && !linearization_->goals.empty());
  double least = std::numeric_limits<double>::infinity();
  for (const GoalTerm& term : linearization_->goals) {
    least = std::min(least, (term.numerator + flip.along(term.row)) / term.divisor);
  }
  return least;
}

bool Ascent::may_fit(const Flip& flip) const {
  return std::ranges::all_of(linearization_->rows, [&](const LocalModel::Row& constraint) {
    const double doubt = constraint.pilot_deg <= kLateFrom_deg ? kEarlyDoubt : kLateDoubt;
    double moved = 0;
    for (const int k : {0, 1})
      moved += std::abs(constraint.row(flip.coordinate[k]) * flip.by_mm[k]);
    return std::max(constraint.slack, 0.0) + flip.along(constraint.row) >= -doubt * moved;
  });
}

// Flips to zero, to either amplitude, and to the next values on a grid.
std::vector<Ascent::Flip> Ascent::single_flips() const {
  std::vector<Flip> flips;
  const VectorXd from_mm = variables_.of(now_.point);
  for (Index k = 0; k < from_mm.size(); ++k) {
    const double most_mm = variables_.largest_mm(k),
                 grid_mm = variables_.range(k) ? 0 : options_.grid_mm;
    std::vector<double> levels_mm = {-most_mm, 0.0, most_mm};
    if (grid_mm > 0) {
      for (const double next_mm : {from_mm(k) - grid_mm, from_mm(k) + grid_mm}) {
        if (std::abs(next_mm) < most_mm) levels_mm.push_back(on_grid(next_mm, grid_mm));
      }
    }
    for (const double to_mm : levels_mm) {
      if (to_mm != from_mm(k)) flips.push_back({{k, k}, {to_mm - from_mm(k), 0}});
    }
  }
  return flips;
}

void Ascent::find_limits() {
  const LocalProgram inside = local_program(*linearization_, kBoxOfLimits * options_.amplitude_mm);
  const LinearOptimum best = maximize(inside.linear);
  if (best.end != LinearOptimum::StopReason::optimal) return;
  Optimised::Limits limits;
  limits.per_floor.resize(options_.floors.size());
  double most_of_energy = 0;
  for (std::size_t k = 0; k < inside.reached.size(); ++k) {
    const LocalModel::Row& constraint = *inside.reached[k];
    const double price = inside.price(best, static_cast<Index>(k));
    assert(best.price.size() == inside.scales.size());
    if (price == 0) continue;
    switch (constraint.kind) {
      case LocalModel::Row::Kind::stroke:
        limits.per_share_of_stroke += price * now_.sheet->way()->flat_mm()(constraint.where);
        break;
      case LocalModel::Row::Kind::force:
        limits.per_n_of_force += price;
        break;
      case LocalModel::Row::Kind::direction:
        limits.turning.push_back({constraint.where, constraint.pilot_deg, price});
        break;
      case LocalModel::Row::Kind::energy:
        if (price > most_of_energy) {
          most_of_energy = price;
          limits.energy_deg = constraint.pilot_deg;
        }
        break;
      case LocalModel::Row::Kind::amplitude:
        limits.per_mm_of_amplitude += price;
        break;
      case LocalModel::Row::Kind::floor:
        limits.per_floor[static_cast<std::size_t>(constraint.where)] += price;
        break;
      case LocalModel::Row::Kind::fold_limit:
      case LocalModel::Row::Kind::fold_angle:
        limits.by_fold_limit = true;
        break;
    }
  }
  std::ranges::sort(limits.turning, std::ranges::greater(), &Optimised::Limits::Turning::per_mm);
  // Sides of the box that lie on the amplitude, or at the end of a range, are limits.
  const Index sides = 2 * linearization_->coordinates, first = best.price.size() - sides;
  for (Index side = 0; side < sides; ++side) {
    if (inside.linear.bounds(first + side) >= 1) continue;
    const double price = inside.price(best, first + side);
    const OptimiseOptions::Range* const range =
        variables_.range(side % linearization_->coordinates);
    if (!range) {
      limits.per_mm_of_amplitude += price;
    } else {
      const bool is_stiffness =
          options_.stiffness_n_per_mm && range == &*options_.stiffness_n_per_mm;
      (is_stiffness ? limits.per_n_per_mm_of_stiffness : limits.per_n_of_preload) +=
          price / variables_.per_mm(*range);
    }
  }
  result_.limits = limits;
}

}  // namespace misalign::solver
