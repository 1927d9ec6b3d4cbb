#include "solver/sheet/held_rest.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace misalign::solver {
namespace {

// Steps in which the way is searched for tops of the energy: three times as many as its stations
// have samples of one degree.
constexpr int kTopSteps = 1000;
constexpr int kBisections = 20;  // of a step
// Distance from the rest, in steps, within which rounding decides the sign of the slope.
constexpr double kBesideRest = 1e-3;

class EnergyAlong {
 public:
  EnergyAlong(const FoldingWay& way, const Filling& filling) : way_(way), filling_(filling) {}

  double energy_n_mm(double x) const {
    way_.find_lengths(x, lengths_mm_, rates_mm_);
    return filling_.energy_n_mm(lengths_mm_);
  }
  double slope(double x) const {
    way_.find_lengths(x, lengths_mm_, rates_mm_);
    return filling_.forces_n(lengths_mm_).dot(rates_mm_);
  }

  // The first place from `from` to `to` at which the energy stops rising; `to` if it rises all the
  // way.
  double top(double from, double to) const {
    const double step = (to - from) / kTopSteps;
    if (step == 0 || slope(from + kBesideRest * step) * step <= 0) return from;
    for (int k = 1; k < kTopSteps; ++k) {
      if (slope(from + k * step) * step <= 0) return top_between(from + (k - 1) * step, step);
    }
    return to;
  }

  // The place of the largest energy, and that energy.
  std::pair<double, double> highest(double from, double to) const {
    const double step = (to - from) / kTopSteps;
    std::pair<double, double> most{from, energy_n_mm(from)};
    for (int k = 1; k <= kTopSteps; ++k) {
      const double at = k == kTopSteps ? to : from + k * step;
      if (const double energy = energy_n_mm(at); energy > most.second) most = {at, energy};
    }
    if (most.first == from || most.first == to) return most;
    const double at = top_between(most.first - step, 2 * step);
    return {at, energy_n_mm(at)};
  }

 private:
  // The top between a place where the energy rises in the direction of `step` and the place a step
  // ahead, where it falls.
  double top_between(double rising, double step) const {
    double falling = rising + step;
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (rising + falling) / 2;
      (slope(middle) * step > 0 ? rising : falling) = middle;
    }
    return falling;
  }

  const FoldingWay& way_;
  const Filling& filling_;
  mutable Eigen::VectorXd lengths_mm_, rates_mm_;
};

}  // namespace

HeldRest held_rest(const FoldingWay& way, const Filling& filling, double rest_deg) {
  assert(rest_deg >= 0 && rest_deg <= way.end_deg());
  const EnergyAlong energy(way, filling);
  const double rest = way.x_of(rest_deg),
               end = way.x_of(std::min(way.end_deg(), way.over_folded_deg().value_or(180)));
  const double above = energy.top(rest, std::max(end, rest)), below = energy.top(rest, 0);
  const auto towards_flat = energy.highest(rest, 0),
             towards_end = energy.highest(rest, std::max(end, rest));
  const auto& least = towards_flat.second < towards_end.second ? towards_flat : towards_end;
  return {way.pilot_deg(above), way.pilot_deg(below), above == end,
          least.second - energy.energy_n_mm(rest), way.pilot_deg(least.first)};
}

}  // namespace misalign::solver
