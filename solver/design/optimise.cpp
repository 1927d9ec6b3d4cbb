#include "solver/design/optimise.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "solver/design/local_model.hpp"

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

class Optimiser {
 public:
  Optimiser(const Model& model, const OptimiseOptions& options)
      : options_(options), solver_(model) {
    found_.options = options;
  }

  Optimised run(const Matrix2Xd& shifts_mm, double value) {
    found_.from_deg = *options_.deploying.from_deg;
    found_.taken.push_back({shifts_mm, value});
    double box_mm = kFirstBox * options_.amplitude_mm;
    Worthy now{std::make_unique<const Sheet>(solver_, shifts_mm), value};
    found_.end = OptimiseEnd::most_steps;
    while (found_.steps() < options_.most_steps) {
      const auto model = local_model(*now.sheet, options_);
      auto next = model ? better(now, *model, box_mm) : std::nullopt;
      if (!next) {
        found_.end = OptimiseEnd::no_step_is_better;
        if (model && !options_.ternary) find_limits(*now.sheet, *model);
        break;
      }
      now = std::move(*next);
      found_.taken.push_back({now.sheet->shifts_mm(), now.value});
    }
    return std::move(found_);
  }

  // What the sheet is worth; none where it does not fit.
  std::optional<double> value_of(const Sheet& sheet) const {
    if (!fits(sheet)) return {};
    if (options_.goal == OptimiseGoal::critical_friction) {
      const auto rigid = standstill(sheet, options_.deploying).study;
      return rigid ? rigid->friction.critical_n_mm_per_mm : std::nullopt;
    }
    const auto bent = bend_panels(sheet, options_.deploying, options_.bending).study;
    if (!bent || bent->unsure() > 0) return {};
    if (options_.goal == OptimiseGoal::bent_critical_friction) {
      return bent->friction.critical_n_mm_per_mm;
    }
    return bent->friction.static_n_mm_per_mm;
  }

  bool fits(const Sheet& sheet) const {
    return sheet.verdict().deploys_from_sample >= options_.deploys_from_sample && sheet.way() &&
           sheet.way()->end_deg() > *options_.deploying.from_deg &&
           (!options_.stroke_limit || stroke(sheet) <= *options_.stroke_limit) &&
           is_strong_enough(sheet);
  }
  bool is_strong_enough(const Sheet& sheet) const {
    return !options_.largest_force_n || force_n(sheet) <= *options_.largest_force_n;
  }

 private:
  // As columns of catalogues have it.
  static double stroke(const Sheet& sheet) {
    return measure(sheet.base(), sheet.vertices_mm(), sheet.record(), sheet.model().sample_deg())
        .stroke_max;
  }

  double force_n(const Sheet& sheet) const {
    const DeployingSheet rigid(*sheet.way(), sheet.model().shape(), sheet.base(),
                               options_.deploying.sheet);
    return rigid.spring_forces_n(sheet.way()->x_of(*options_.deploying.from_deg))
        .cwiseAbs()
        .maxCoeff();
  }

  Index coordinates() const { return 2 * std::ssize(options_.shifted); }
  double& coordinate(Matrix2Xd& shifts_mm, Index k) const {
    return shifts_mm(k % 2, options_.shifted[static_cast<std::size_t>(k / 2)]);
  }
  VectorXd own(const Sheet& sheet) const {
    Matrix2Xd shifts_mm = sheet.shifts_mm();
    VectorXd own_mm(coordinates());
    for (Index k = 0; k < own_mm.size(); ++k) own_mm(k) = coordinate(shifts_mm, k);
    return own_mm;
  }

  std::optional<Worthy> look(const Sheet& from, const VectorXd& change_mm) {
    Matrix2Xd shifts_mm = from.shifts_mm();
    for (Index k = 0; k < change_mm.size(); ++k) coordinate(shifts_mm, k) += change_mm(k);
    auto sheet = std::make_unique<const Sheet>(solver_, std::move(shifts_mm));
    ++found_.looks;
    const std::optional<double> value = value_of(*sheet);
    if (!value) return {};
    return Worthy{std::move(sheet), *value};
  }

  LocalProgram program(const Sheet& sheet, const LocalModel& model, double box_mm) const {
    const Eigen::ArrayXd own_mm = own(sheet).array();
    return local_program(model, box_mm, options_.amplitude_mm - own_mm,
                         options_.amplitude_mm + own_mm);
  }

  std::optional<Worthy> better(const Worthy& now, const LocalModel& model, double& box_mm) {
    if (!options_.ternary) {
      if (auto next = moved(now, model, box_mm)) return next;
      box_mm = kFirstBox * options_.amplitude_mm;
    }
    return flipped(now, model);
  }

  // A step of free shifts: the box shrinks until one is right.
  std::optional<Worthy> moved(const Worthy& now, const LocalModel& model, double& box_mm) {
    while (box_mm >= kLastBox * options_.amplitude_mm) {
      const LocalProgram inside = program(*now.sheet, model, box_mm);
      const LinearOptimum best = maximize(inside.linear);
      const double foreseen = best.value * inside.unit;
      if (best.end != LinearEnd::optimal || foreseen < kWorth * now.value) return {};
      const VectorXd change_mm = inside.change_mm(best);
      auto next = look(*now.sheet, change_mm);
      const double gained = next ? next->value - now.value : 0;
      if (gained > kForeseen * foreseen) {
        box_mm = std::min(2 * box_mm, options_.amplitude_mm);
        return next;
      }
      box_mm /= 2;
      if (gained > kWorth * now.value) return next;
    }
    return {};
  }

  bool may_fit(const LocalModel& model, const VectorXd& change_mm) const {
    return std::ranges::all_of(model.rows, [&](const LocalRow& one) {
      const double doubt = one.pilot_deg <= kLateFrom_deg ? kEarlyDoubt : kLateDoubt;
      const double moved = one.row.cwiseAbs().dot(change_mm.cwiseAbs());
      return std::max(one.slack, 0.0) + one.row.dot(change_mm) >= -doubt * moved;
    });
  }

  std::vector<VectorXd> single_flips(const Sheet& sheet) const {
    std::vector<VectorXd> flips;
    const VectorXd own_mm = own(sheet);
    for (Index k = 0; k < own_mm.size(); ++k) {
      for (const double to_mm : {-options_.amplitude_mm, 0.0, options_.amplitude_mm}) {
        if (to_mm != own_mm(k))
          flips.push_back((to_mm - own_mm(k)) * VectorXd::Unit(own_mm.size(), k));
      }
    }
    return flips;
  }

  // A step of ternary shifts: of one or two flips the first that does better, those first that
  // promise most.
  std::optional<Worthy> flipped(const Worthy& now, const LocalModel& model) {
    const std::vector<VectorXd> singles = single_flips(*now.sheet);
    const double own_goal = model.goal(VectorXd::Zero(coordinates()));
    std::vector<Flip> flips;
    const auto consider = [&](const VectorXd& change_mm) {
      const double foreseen = model.goal(change_mm) - own_goal;
      if (foreseen > kWorth * now.value) flips.push_back({change_mm, foreseen});
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
      auto next = look(*now.sheet, flip.change_mm);
      if (next && next->value > now.value * (1 + kWorth)) return next;
    }
    // None of those that promise: before it is given up, of single ones every one is looked at.
    for (const VectorXd& change_mm : singles) {
      auto next = look(*now.sheet, change_mm);
      if (next && next->value > now.value * (1 + kWorth)) return next;
    }
    return {};
  }

  void find_limits(const Sheet& sheet, const LocalModel& model) {
    const double box_mm = kBoxOfLimits * options_.amplitude_mm;
    const LocalProgram inside = program(sheet, model, box_mm);
    const LinearOptimum best = maximize(inside.linear);
    if (best.end != LinearEnd::optimal) return;
    OptimiseLimits limits;
    for (std::size_t k = 0; k < inside.reached.size(); ++k) {
      const LocalRow& one = *inside.reached[k];
      const double price = inside.price(best, static_cast<Index>(k));
      if (price == 0) continue;
      if (one.of == LocalRow::Of::stroke) {
        limits.per_share_of_stroke += price * sheet.way()->flat_mm()(one.where);
      } else if (one.of == LocalRow::Of::force) {
        limits.per_n_of_force += price / options_.deploying.sheet.springs.stiffness_n_per_mm;
      } else if (one.of == LocalRow::Of::direction) {
        limits.turning.push_back({one.where, one.pilot_deg, price});
      } else {
        limits.by_fold_limit = true;
      }
    }
    std::ranges::sort(limits.turning, std::ranges::greater(), &OptimiseLimits::Turning::per_mm);
    // Of the box those sides that are the amplitude's.
    for (Index row = best.price.size() - 2 * coordinates(); row < best.price.size(); ++row) {
      if (inside.linear.bounds(row) < 1) limits.per_mm_of_amplitude += inside.price(best, row);
    }
    found_.limits = limits;
  }

  const OptimiseOptions& options_;
  SheetSolver solver_;
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
  const Studied<DeployOptions> fitted = fitted_release(start, options.deploying);
  if (fitted.fault) return *fitted.fault;
  if (!fitted.study || start.model().has_spare_equations()) return {};
  if (auto fault = start_fault(start, options)) return *fault;
  OptimiseOptions from = options;
  from.deploying.from_deg = fitted.study->motion.from_deg;
  Optimiser optimiser(start.model(), from);
  if (!optimiser.is_strong_enough(start)) {
    return OptionFault{"largest_force_n", shown("%g", *options.largest_force_n),
                       "a spring of the sheet that it starts from pulls or pushes with more",
                       "name a larger one, weaker springs, or another sheet"};
  }
  if (!optimiser.fits(start)) {
    return OptionFault{"stroke_limit", shown("%g", options.stroke_limit.value_or(0)),
                       "a diagonal of the sheet that it starts from elongates by more",
                       "name a larger one, or another sheet"};
  }
  const std::optional<double> value = optimiser.value_of(start);
  if (!value || *value <= 0) {
    return OptionFault{"goal",
                       {},
                       "nothing drives the sheet that it starts from to flat",
                       "begin with another sheet, or with another goal"};
  }
  return optimiser.run(start.shifts_mm(), *value);
}

}  // namespace misalign::solver
