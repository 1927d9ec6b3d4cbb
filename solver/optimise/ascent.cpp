#include "solver/optimise/ascent.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/optimise/goal_functions.hpp"
#include "solver/optimise/local_program.hpp"
#include "solver/optimise/objective.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::VectorXd;

// The box of a linear program, in amplitudes: at first, and where it is given up.
constexpr double kFirstBox = 0.25, kLastBox = 1e-3;
// A step that gains less than this share of the goal is none.
constexpr double kLeastGain = 1e-4;
// The box grows where this share of what was foreseen came true.
constexpr double kForeseen = 0.5;
// The limits at the end are those of a box of so many amplitudes.
constexpr double kBoxOfLimits = 0.05;
// What flips may seem to turn back and yet be looked at, of what they move: to first order slopes
// are off by 7 % at 120 degrees, and by half at 150.
constexpr double kEarlyDoubt = 0.15, kLateDoubt = 0.6, kLateFrom_deg = 120;

std::optional<OptionFault> shifts_fault(const Sheet& start, const OptimiseOptions& options) {
  const double amplitude_mm = options.amplitude_mm;
  if (amplitude_mm <= 0) {
    return OptionFault{"amplitude_mm", shown("%g", amplitude_mm),
                       "leaves no room: the sheet that it starts from is not shifted either",
                       "name one, such as 0.4"};
  }
  for (const int vertex : options.shifted) {
    for (const double shift_mm : start.shifts_mm().col(vertex)) {
      if (on_grid(shift_mm, options.grid_mm) != shift_mm) {
        return OptionFault{"grid_mm", shown("%g", options.grid_mm),
                           "the sheet that it starts from has a shift of " + shown("%g", shift_mm) +
                               " mm, which does not lie on it",
                           "name another one, or none"};
      }
      const bool is_level = shift_mm == 0 || std::abs(shift_mm) == amplitude_mm;
      if (std::abs(shift_mm) > amplitude_mm * (1 + 1e-12) || (options.ternary && !is_level)) {
        return OptionFault{
            "amplitude_mm", shown("%g", amplitude_mm),
            "the sheet that it starts from has a shift of " + shown("%g", shift_mm) + " mm" +
                (options.ternary ? ", and ternary shifts are 0 or the amplitude" : ""),
            options.ternary ? "leave out ternary, or name its own amplitude" : "name a larger one"};
      }
    }
  }
  const double d_deg = start.deploys_from_deg(),
               wanted_deg = start.sample_deg(options.deploys_from_sample);
  if (d_deg < wanted_deg) {
    return OptionFault{"deploys_from_deg", shown("%g", wanted_deg),
                       "the sheet that it starts from deploys from " + shown("%g", d_deg) + " deg",
                       "name no more than that, or another sheet"};
  }
  return {};
}

}  // namespace

StudyResult<AscentStart> fitted_start(const Sheet& start, const OptimiseOptions& options) {
  assert(!options.shifted.empty() && options.deploys_from_sample > 0);
  assert(options.moves.size() == 0 || options.moves.rows() == 2 * std::ssize(options.shifted));
  if (start.model().has_spare_equations()) return NoResult::overconstrained;
  const StudyResult<ReleaseOptions> fitted = validated_release(start, options.deploying);
  if (!fitted) return fitted.obstacle();
  if (auto fault = shifts_fault(start, options)) return *fault;
  OptimiseOptions from = options;
  from.deploying.from_deg = fitted->motion.from_deg;
  if (!is_strong_enough(start, from)) {
    return OptionFault{"largest_force_n", shown("%g", *options.largest_force_n),
                       "a spring of the sheet that it starts from pulls or pushes with more",
                       "name a larger one, weaker springs, or another sheet"};
  }
  if (!fits(start, from)) {
    return OptionFault{"stroke_limit", shown("%g", options.stroke_limit.value_or(0)),
                       "a diagonal of the sheet that it starts from elongates by more",
                       "name a larger one, or another sheet"};
  }
  for (const OptimiseFloor& floor : from.floors) {
    const auto its = value_of(*floor.goal, start, from);
    if (its && *its >= floor.least) continue;
    return OptionFault{"subject_to", shown(">= %g", floor.least),
                       its ? "the sheet that it starts from has " + shown("%.4g", *its)
                           : "of the sheet that it starts from it is not known",
                       "ask for less, or begin with another sheet"};
  }
  const std::optional<double> value = value_of(*from.goal, start, from);
  if (!value || *value <= 0) {
    return OptionFault{"goal", {}, from.goal->infeasible, from.goal->suggestion};
  }
  return AscentStart{std::move(from), *value};
}

Ascent::Ascent(const Sheet& start, AscentStart fitted)
    : options_(std::move(fitted.options)),
      variables_(options_),
      solver_(start.model()),
      box_mm_(kFirstBox * options_.amplitude_mm),
      now_{std::make_unique<const Sheet>(solver_, start.shifts_mm()),
           point_of(start.shifts_mm(), options_), fitted.value} {
  assert(options_.amplitude_mm > 0 && now_.value > 0);
  found_.options = options_;
  found_.from_deg = *options_.deploying.from_deg;
  found_.taken.push_back({now_.point, now_.value});
}

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
  if (found_.steps() >= options_.most_steps) return end(StopReason::most_steps);
  if (now_.value >= options_.goal->largest) return end(StopReason::no_step_is_better);
  linearization_ = local_model(*now_.sheet, options_);
  if (!linearization_) return end(StopReason::no_step_is_better);
  trying_ = Trying::in_a_box;
  if (options_.ternary) begin_flips();
}

void Ascent::end(StopReason why) {
  found_.stop_reason = why;
  finished_ = true;
  if (linearization_ && !options_.ternary && options_.goal->is_exact) find_limits();
}

void Ascent::take_step(Feasible next) {
  assert(next.value > now_.value && "each step does better");
  now_ = std::move(next);
  set_springs(options_, now_.point);
  found_.taken.push_back({now_.point, now_.value});
  linearization_.reset();
}

// Of a step of free shifts: the box shrinks until one is right.
void Ascent::try_box() {
  assert(linearization_ && box_mm_ > 0);
  if (box_mm_ < std::max(kLastBox * options_.amplitude_mm, options_.grid_mm / 2)) {
    return give_up_box();
  }
  const LocalProgram inside = local_program(*linearization_, box_mm_);
  const LinearOptimum best = maximize(inside.linear);
  const double foreseen = best.value * inside.unit;
  if (best.end != LinearEnd::optimal || foreseen <= least_foreseen()) return give_up_box();
  auto next = evaluate(inside.change_mm(best));
  const double gained = next ? next->value - now_.value : 0;
  if (gained > (options_.goal->is_exact ? kForeseen * foreseen : kLeastGain * now_.value)) {
    box_mm_ = std::min(2 * box_mm_, options_.amplitude_mm);
    return take_step(std::move(*next));
  }
  box_mm_ /= 2;
  if (gained > kLeastGain * now_.value) take_step(std::move(*next));
}

void Ascent::give_up_box() {
  box_mm_ = kFirstBox * options_.amplitude_mm;
  if (variables_.are_free()) return end(StopReason::no_step_is_better);
  begin_flips();
}

// Of one or two coordinates: those first that promise most. None of those that promise: before it
// is given up, of single ones every one is looked at.
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
  for (std::size_t one = 0; one < singles_.size(); ++one) {
    consider(singles_[one]);
    for (std::size_t other = one + 1; other < singles_.size(); ++other) {
      const Index first = singles_[one].coordinate[0], second = singles_[other].coordinate[0];
      if (first == second) continue;
      consider({{first, second}, {singles_[one].by_mm[0], singles_[other].by_mm[0]}});
    }
  }
  std::ranges::stable_sort(promising_, std::ranges::greater(), &Flip::foreseen);
}

// The first that does better is a step.
void Ascent::try_flip() {
  const bool by_promise = trying_ == Trying::promising_flips;
  std::vector<Flip>& flips = by_promise ? promising_ : singles_;
  while (by_promise && next_flip_ < flips.size() && !may_fit(flips[next_flip_])) ++next_flip_;
  if (next_flip_ == flips.size() ||
      (by_promise && evaluations_of_step_ == options_.most_evaluations)) {
    if (!by_promise) return end(StopReason::no_step_is_better);
    trying_ = Trying::single_flips;
    next_flip_ = 0;
    return;
  }
  const Flip& flip = flips[next_flip_++];
  ++evaluations_of_step_;
  VectorXd change_mm = VectorXd::Zero(linearization_->coordinates);
  for (const int k : {0, 1}) change_mm(flip.coordinate[k]) += flip.by_mm[k];
  auto next = evaluate(change_mm);
  if (next && next->value > now_.value * (1 + kLeastGain)) take_step(std::move(*next));
}

std::optional<Ascent::Feasible> Ascent::evaluate(const VectorXd& change_mm) {
  DesignPoint point = variables_.after(now_.point, change_mm);
  auto sheet = std::make_unique<const Sheet>(solver_, point.shifts_mm);
  ++found_.evaluations;
  OptimiseOptions there = options_;
  set_springs(there, point);
  const std::optional<double> value = objective(*sheet, there);
  if (!value || !keeps_slope(*sheet, *now_.sheet, options_)) return {};
  return Feasible{std::move(sheet), std::move(point), *value};
}

// That is tried: of what only leads to the goal anything.
double Ascent::least_foreseen() const {
  return options_.goal->is_exact ? kLeastGain * now_.value : 0;
}

double Ascent::goal_after(const Flip& flip) const {
  assert(linearization_ && !linearization_->goals.empty());
  double least = std::numeric_limits<double>::infinity();
  for (const LocalGoal& one : linearization_->goals) {
    least = std::min(least, (one.amount + flip.along(one.row)) / one.over);
  }
  return least;
}

bool Ascent::may_fit(const Flip& flip) const {
  return std::ranges::all_of(linearization_->rows, [&](const LocalRow& one) {
    const double doubt = one.pilot_deg <= kLateFrom_deg ? kEarlyDoubt : kLateDoubt;
    double moved = 0;
    for (const int k : {0, 1}) moved += std::abs(one.row(flip.coordinate[k]) * flip.by_mm[k]);
    return std::max(one.slack, 0.0) + flip.along(one.row) >= -doubt * moved;
  });
}

// To nothing, to the amplitude, and to what is next on a grid.
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
  if (best.end != LinearEnd::optimal) return;
  OptimiseLimits limits;
  limits.per_floor.resize(options_.floors.size());
  for (std::size_t k = 0; k < inside.reached.size(); ++k) {
    const LocalRow& one = *inside.reached[k];
    const double price = inside.price(best, static_cast<Index>(k));
    assert(best.price.size() == inside.scales.size());
    if (price == 0) continue;
    switch (one.kind) {
      case LocalRow::Kind::stroke:
        limits.per_share_of_stroke += price * now_.sheet->way()->flat_mm()(one.where);
        break;
      case LocalRow::Kind::force:
        limits.per_n_of_force += price;
        break;
      case LocalRow::Kind::direction:
        limits.turning.push_back({one.where, one.pilot_deg, price});
        break;
      case LocalRow::Kind::amplitude:
        limits.per_mm_of_amplitude += price;
        break;
      case LocalRow::Kind::floor:
        limits.per_floor[static_cast<std::size_t>(one.where)] += price;
        break;
      case LocalRow::Kind::fold_limit:
      case LocalRow::Kind::fold_angle:
        limits.by_fold_limit = true;
        break;
    }
  }
  std::ranges::sort(limits.turning, std::ranges::greater(), &OptimiseLimits::Turning::per_mm);
  // Of the box those sides that are the amplitude's, or the ends of a range.
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
  found_.limits = limits;
}

}  // namespace misalign::solver
