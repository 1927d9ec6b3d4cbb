#include "solver/design/optimise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "solver/design/local_model.hpp"
#include "solver/design/worth.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::VectorXd;

// The box of a linear program, in amplitudes: at first, and where it is given up.
constexpr double kFirstBox = 0.25, kLastBox = 1e-3;
// A step that is worth so little of the goal is none.
constexpr double kWorth = 1e-4;
// The box grows where this share of what was foreseen came true.
constexpr double kForeseen = 0.5;
// The limits at the end are those of a box of so many amplitudes.
constexpr double kBoxOfLimits = 0.05;
// What flips may seem to turn back and yet be looked at, of what they move: to first order slopes
// are off by 7 % at 120 degrees, and by half at 150.
constexpr double kEarlyDoubt = 0.15, kLateDoubt = 0.6, kLateFrom_deg = 120;

// What is rounded to a grid lies on it; 0: there is none.
double on_grid(double mm, double grid_mm) {
  return grid_mm > 0 ? std::round(mm / grid_mm) * grid_mm : mm;
}

class Optimiser {
 public:
  Optimiser(const Sheet& start, double value, const OptimiseOptions& options)
      : options_(options),
        solver_(start.model()),
        box_mm_(kFirstBox * options.amplitude_mm),
        now_{std::make_unique<const Sheet>(solver_, start.shifts_mm()), value} {
    found_.options = options;
    found_.from_deg = *options.deploying.from_deg;
    found_.taken.push_back({start.shifts_mm(), value});
  }

  Optimised run() {
    found_.end = OptimiseEnd::most_steps;
    while (found_.steps() < options_.most_steps) {
      const auto model = local_model(*now_.sheet, options_);
      auto next = model ? better(*model) : std::nullopt;
      if (!next) {
        found_.end = OptimiseEnd::no_step_is_better;
        if (model && !options_.ternary) find_limits(*model);
        break;
      }
      now_ = std::move(*next);
      found_.taken.push_back({now_.sheet->shifts_mm(), now_.value});
    }
    return std::move(found_);
  }

 private:
  // A sheet that fits, and what it is worth.
  struct Worthy {
    std::unique_ptr<const Sheet> sheet;
    double value;
  };
  // A change of few coordinates, and what it would be worth.
  struct Flip {
    VectorXd change_mm;
    double foreseen;
  };

  bool moves_together() const { return options_.moves.size() > 0; }
  double& coordinate(Matrix2Xd& shifts_mm, Index k) const {
    return shifts_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]);
  }
  // x and y of each vertex that may be shifted, in turn.
  VectorXd own() const {
    Matrix2Xd shifts_mm = now_.sheet->shifts_mm();
    VectorXd own_mm(2 * std::ssize(options_.shifted));
    for (Index k = 0; k < own_mm.size(); ++k) own_mm(k) = coordinate(shifts_mm, k);
    return own_mm;
  }

  std::optional<Worthy> look(const VectorXd& coordinates_mm) {
    Matrix2Xd shifts_mm = now_.sheet->shifts_mm();
    const VectorXd change_mm =
        moves_together() ? VectorXd(options_.moves * coordinates_mm) : coordinates_mm;
    for (Index k = 0; k < change_mm.size(); ++k) {
      double& shift_mm = coordinate(shifts_mm, k);
      shift_mm = on_grid(shift_mm + change_mm(k), options_.grid_mm);
      // Programs pass their bounds by rounding, and grids by up to half a step.
      if (!moves_together()) shift_mm = std::clamp(shift_mm, -largest_mm(), largest_mm());
    }
    auto sheet = std::make_unique<const Sheet>(solver_, std::move(shifts_mm));
    ++found_.looks;
    const std::optional<double> value = worth(*sheet, options_);
    if (!value) return {};
    return Worthy{std::move(sheet), *value};
  }

  std::optional<Worthy> better(const LocalModel& model) {
    if (!options_.ternary) {
      if (auto next = moved(model)) return next;
      box_mm_ = kFirstBox * options_.amplitude_mm;
    }
    return moves_together() ? std::nullopt : flipped(model);
  }

  bool is_better(const std::optional<Worthy>& next) const {
    return next && next->value > now_.value * (1 + kWorth);
  }

  // A step of free shifts: the box shrinks until one is right.
  std::optional<Worthy> moved(const LocalModel& model) {
    while (box_mm_ >= std::max(kLastBox * options_.amplitude_mm, options_.grid_mm / 2)) {
      const LocalProgram inside = local_program(model, box_mm_);
      const LinearOptimum best = maximize(inside.linear);
      const double foreseen = best.value * inside.unit;
      if (best.end != LinearEnd::optimal || foreseen < kWorth * now_.value) return {};
      auto next = look(inside.change_mm(best));
      const double gained = next ? next->value - now_.value : 0;
      if (gained > kForeseen * foreseen) {
        box_mm_ = std::min(2 * box_mm_, options_.amplitude_mm);
        return next;
      }
      box_mm_ /= 2;
      if (gained > kWorth * now_.value) return next;
    }
    return {};
  }

  // No farther than the amplitude, on the grid.
  double largest_mm() const {
    const double grid_mm = options_.grid_mm;
    if (grid_mm == 0) return options_.amplitude_mm;
    return std::floor(options_.amplitude_mm / grid_mm * (1 + 1e-12)) * grid_mm;
  }

  bool may_fit(const LocalModel& model, const VectorXd& change_mm) const {
    return std::ranges::all_of(model.rows, [&](const LocalRow& one) {
      const double doubt = one.pilot_deg <= kLateFrom_deg ? kEarlyDoubt : kLateDoubt;
      const double moved = one.row.cwiseAbs().dot(change_mm.cwiseAbs());
      return std::max(one.slack, 0.0) + one.row.dot(change_mm) >= -doubt * moved;
    });
  }

  // To nothing, to the amplitude, and to what is next on a grid.
  std::vector<VectorXd> single_flips() const {
    std::vector<VectorXd> flips;
    const VectorXd own_mm = own();
    const double most_mm = largest_mm(), grid_mm = options_.grid_mm;
    for (Index k = 0; k < own_mm.size(); ++k) {
      std::vector<double> levels_mm = {-most_mm, 0.0, most_mm};
      if (grid_mm > 0) {
        for (const double next_mm : {own_mm(k) - grid_mm, own_mm(k) + grid_mm}) {
          if (std::abs(next_mm) < most_mm) levels_mm.push_back(on_grid(next_mm, grid_mm));
        }
      }
      for (const double to_mm : levels_mm) {
        if (to_mm != own_mm(k))
          flips.push_back((to_mm - own_mm(k)) * VectorXd::Unit(own_mm.size(), k));
      }
    }
    return flips;
  }

  // A step of ternary shifts: of one or two flips the first that does better, those first that
  // promise most.
  std::optional<Worthy> flipped(const LocalModel& model) {
    const std::vector<VectorXd> singles = single_flips();
    const double own_goal = model.goal(VectorXd::Zero(model.coordinates));
    std::vector<Flip> flips;
    const auto consider = [&](const VectorXd& change_mm) {
      const double foreseen = model.goal(change_mm) - own_goal;
      if (foreseen > kWorth * now_.value) flips.push_back({change_mm, foreseen});
    };
    for (std::size_t one = 0; one < singles.size(); ++one) {
      consider(singles[one]);
      for (std::size_t other = one + 1; other < singles.size(); ++other) {
        if (singles[one].cwiseProduct(singles[other]).isZero(0)) {
          consider(singles[one] + singles[other]);
        }
      }
    }
    std::ranges::stable_sort(flips, std::ranges::greater(), &Flip::foreseen);
    int looks = 0;
    for (const Flip& flip : flips) {
      if (!may_fit(model, flip.change_mm)) continue;
      if (looks++ == options_.most_looks) break;
      if (auto next = look(flip.change_mm); is_better(next)) return next;
    }
    // None of those that promise: before it is given up, of single ones every one is looked at.
    for (const VectorXd& change_mm : singles) {
      if (auto next = look(change_mm); is_better(next)) return next;
    }
    return {};
  }

  void find_limits(const LocalModel& model) {
    const LocalProgram inside = local_program(model, kBoxOfLimits * options_.amplitude_mm);
    const LinearOptimum best = maximize(inside.linear);
    if (best.end != LinearEnd::optimal) return;
    OptimiseLimits limits;
    for (std::size_t k = 0; k < inside.reached.size(); ++k) {
      const LocalRow& one = *inside.reached[k];
      const double price = inside.price(best, static_cast<Index>(k));
      if (price == 0) continue;
      if (one.of == LocalRow::Of::stroke) {
        limits.per_share_of_stroke += price * now_.sheet->way()->flat_mm()(one.where);
      } else if (one.of == LocalRow::Of::force) {
        limits.per_n_of_force += price / options_.deploying.sheet.springs.stiffness_n_per_mm;
      } else if (one.of == LocalRow::Of::direction) {
        limits.turning.push_back({one.where, one.pilot_deg, price});
      } else if (one.of == LocalRow::Of::amplitude) {
        limits.per_mm_of_amplitude += price;
      } else {
        limits.by_fold_limit = true;
      }
    }
    std::ranges::sort(limits.turning, std::ranges::greater(), &OptimiseLimits::Turning::per_mm);
    // Of the box those sides that are the amplitude's.
    for (Index row = best.price.size() - 2 * model.coordinates; row < best.price.size(); ++row) {
      if (inside.linear.bounds(row) < 1) limits.per_mm_of_amplitude += inside.price(best, row);
    }
    found_.limits = limits;
  }

  const OptimiseOptions& options_;
  SheetSolver solver_;
  double box_mm_;
  Worthy now_;
  Optimised found_{};
};

std::optional<OptionFault> start_fault(const Sheet& start, const OptimiseOptions& options) {
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

Studied<Optimised> optimise(const Sheet& start, const OptimiseOptions& options) {
  assert(!options.shifted.empty() && options.deploys_from_sample > 0);
  assert(options.moves.size() == 0 || options.moves.rows() == 2 * std::ssize(options.shifted));
  const Studied<DeployOptions> fitted = fitted_release(start, options.deploying);
  if (fitted.fault) return *fitted.fault;
  if (!fitted.study || start.model().has_spare_equations()) return {};
  if (auto fault = start_fault(start, options)) return *fault;
  OptimiseOptions from = options;
  from.deploying.from_deg = fitted.study->motion.from_deg;
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
  const std::optional<double> value = worth(start, from);
  if (!value || *value <= 0) {
    const bool is_margin = options.goal == OptimiseGoal::miscut_margin;
    return OptionFault{"goal",
                       {},
                       is_margin
                           ? "no margin against miscuts is known of the sheet that it starts from"
                           : "nothing drives the sheet that it starts from to flat",
                       "begin with another sheet, or with another goal"};
  }
  return Optimiser(start, *value, from).run();
}

}  // namespace misalign::solver
