#include "solver/motion/deployment.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "generated/features.hpp"
#include "solver/motion/motion_integrator.hpp"

namespace misalign::solver {
namespace {

// Springs with a smaller elongation are relaxed: lengths are known to 1e-10 mm.
constexpr double kRelaxed_mm = 1e-8;

// Time is counted in the sheet's own unit, in which the motion takes about 1.
double time_unit_s(const EnergyModel& sheet, double from_x, const std::vector<double>& wells_x) {
  const EnergyAt start = sheet.at(from_x);
  double released = std::abs(start.potential - sheet.at(0).potential);
  for (const double x : wells_x) {
    released = std::max(released, start.potential - sheet.at(x).potential);
  }
  if (!(released > 0)) return 1;
  return std::abs(from_x) * std::sqrt(start.mass / (2 * released));
}

// The sheet is at rest this close to where friction holds it.
constexpr double kCreep_deg = 1e-5;

class Run {
 public:
  Run(const EnergyModel& sheet, const std::vector<double>& wells_x,
      const Deployment::Options& options)
      : sheet_(sheet),
        way_(sheet.way()),
        options_(options),
        from_x_(way_.x_of(options.from_deg)),
        unit_s_(time_unit_s(sheet, from_x_, wells_x)),
        integrator_([this](double x, double rate) { return acceleration(x, rate); },
                    sheet.options().joints.damping_n_mm_s_per_mm > 0
                        ? MotionIntegrator::Method::backward_differences
                        : MotionIntegrator::Method::adams,
                    way_.end(), std::abs(from_x_), options.relative_tolerance) {
    assert(std::abs(from_x_) < way_.end() && "the way reaches beyond the start");
    assert(options.row_deg > 0 && options.time_limit_s > 0);
    for (const double x : wells_x) wells_.push_back(well_at(x));
  }

  Deployment run() {
    const MotionIntegrator::State start{0, from_x_, 0};
    add_row(start, Deployment::Event::start);
    if (is_held(from_x_)) return end(held_at(from_x_));
    set_off(start);
    for (;;) {
      const MotionIntegrator::State before = integrator_.state();
      const MotionIntegrator::Stop stop = integrator_.step();
      ++run_.steps;
      if (stop == MotionIntegrator::Stop::failed) return end(Outcome::failed);
      add_rows_between(before, integrator_.state());
      if (const auto outcome = after(stop)) return end(*outcome);
    }
  }

 private:
  using Stop = MotionIntegrator::Stop;

  double acceleration(double x, double rate) const {
    const EnergyAt energy = sheet_.at(x);
    const double speed = rate / unit_s_;  // per second
    assert(energy.mass > 0);
    const double force = -energy.mass_slope * speed * speed / 2 - energy.slope -
                         direction_ * energy.friction - energy.damping * speed;
    return unit_s_ * unit_s_ * force / energy.mass;
  }

  // Returns the outcome of a stop; none where the motion continues.
  std::optional<Outcome> after(Stop stop) {
    const MotionIntegrator::State state = integrator_.state();
    switch (stop) {
      case Stop::at_zero:
        add_row(state, Deployment::Event::flat);
        if (options_.latch) return Outcome::latched;
        if (options_.restitution) return bounced(state);
        if (++run_.passes > options_.swings) return Outcome::passed_flat;
        return {};
      case Stop::at_rest:
        add_row({state.time, state.x, 0}, Deployment::Event::turn);
        ++run_.turns;
        if (is_held(state.x)) return held_at(state.x);
        if (!loses_energy() && run_.turns > options_.swings) {
          return Outcome::turned_back;
        }
        set_off({state.time, state.x, 0});
        return {};
      case Stop::at_end:
        add_row(state, Deployment::Event::end);
        return Outcome::fold_limit;
      case Stop::at_time:
        add_row(state, Deployment::Event::end);
        return Outcome::time_limit;
      case Stop::step:
      case Stop::failed:
        break;
    }
    return at_rest(state);
  }

  bool loses_energy() const { return sheet_.options().joints.slows_down() || options_.restitution; }

  // Bounces off the stop at flat, or stays there if its energy does not take it out of the
  // neighbourhood.
  std::optional<Outcome> bounced(const MotionIntegrator::State& state) {
    assert(*options_.restitution >= 0 && *options_.restitution < 1);
    const MotionIntegrator::State back{state.time, 0, -*options_.restitution * state.rate};
    const EnergyAt flat = sheet_.at(0), beside = sheet_.at(way_.x_of(options_.flat_deg));
    if (flat.potential + kinetic(flat, back.rate) <= beside.potential) {
      add_row({state.time, 0, 0}, Deployment::Event::end);
      return Outcome::flat;
    }
    ++run_.bounces;
    move(back, back.rate > 0 ? 1 : -1);
    return {};
  }

  void set_off(const MotionIntegrator::State& from) {
    move(from, sheet_.at(from.x).slope > 0 ? -1 : 1);
  }
  void move(const MotionIntegrator::State& from, int direction) {
    assert(std::abs(direction) == 1);
    direction_ = direction;
    integrator_.start(from);
    integrator_.stop_at(options_.time_limit_s / unit_s_);
  }

  // Returns whether it stays at rest there: friction holds it, or nothing drives it.
  bool is_held(double x) const {
    const EnergyAt energy = sheet_.at(x);
    const bool relaxed = sheet_.is_filling_relaxed(x, kRelaxed_mm) && sheet_.all_else(x).slope == 0;
    return relaxed || std::abs(energy.slope) <= energy.friction;
  }
  Outcome held_at(double x) const {
    const double pilot_deg = way_.pilot_deg(x);
    if (std::abs(pilot_deg) <= options_.flat_deg) return Outcome::flat;
    for (const Well& well : wells_) {
      const double apart_deg = std::abs(pilot_deg - way_.pilot_deg(well.x));
      if (apart_deg <= options_.well_deg) return Outcome::at_rest;
    }
    return Outcome::stalled;
  }

  // A well, and the energy that leaves its neighbourhood.
  struct Well {
    double x, edge;
  };
  Well well_at(double x) const {
    const double pilot_deg = way_.pilot_deg(x);
    const double around_deg = x == 0 ? options_.flat_deg : options_.well_deg;
    double edge = std::numeric_limits<double>::infinity();
    for (const double at_deg : {pilot_deg - around_deg, pilot_deg + around_deg}) {
      if (std::abs(at_deg) >= way_.end_deg()) continue;
      edge = std::min(edge, sheet_.at(way_.x_of(at_deg)).potential);
    }
    return {x, edge};
  }

  // Returns whether friction will hold it within kCreep_deg: it would come to rest there at once,
  // or creep for ever.
  bool creeps_to_rest(const MotionIntegrator::State& state, const EnergyAt& now) const {
    if (now.friction <= 0 || state.rate == 0) return false;
    const double ahead_x =
        state.x +
        std::copysign(kCreep_deg / std::abs(way_.pilot_rate(state.x) / kRadPerDeg), state.rate);
    if (std::abs(ahead_x) >= way_.end() || ahead_x * state.x <= 0) return false;
    const EnergyAt ahead = sheet_.at(ahead_x);
    if (std::abs(ahead.slope) > ahead.friction) return false;  // it turns back there
    const double lost = (now.friction + ahead.friction) / 2 * std::abs(ahead_x - state.x);
    return now.potential + kinetic(now, state.rate) - ahead.potential < lost;
  }

  // Returns the outcome of rest: in the nearest well, without the energy to leave its
  // neighbourhood, or next to where friction holds it.
  std::optional<Outcome> at_rest(const MotionIntegrator::State& state) {
    if (!sheet_.options().joints.slows_down()) return {};
    if (creeps_to_rest(state, sheet_.at(state.x))) {
      add_row({state.time, state.x, 0}, Deployment::Event::end);
      return held_at(state.x);
    }
    if (wells_.empty()) return {};
    const Well& well =
        *std::min_element(wells_.begin(), wells_.end(), [&](const Well& a, const Well& b) {
          return std::abs(state.x - a.x) < std::abs(state.x - b.x);
        });
    const EnergyAt now = sheet_.at(state.x);
    if (now.potential + kinetic(now, state.rate) > well.edge) return {};
    add_row(state, Deployment::Event::end);
    return held_at(state.x);
  }

  double kinetic(const EnergyAt& energy, double rate) const {
    return energy.mass / 2 * (rate / unit_s_) * (rate / unit_s_);
  }

  // Adds rows at the multiples of row_deg that were passed; x is monotone between two stops.
  void add_rows_between(const MotionIntegrator::State& before,
                        const MotionIntegrator::State& after) {
    const double from_deg = way_.pilot_deg(before.x), to_deg = way_.pilot_deg(after.x);
    const int sign = to_deg > from_deg ? 1 : -1;
    constexpr double kSame = 1e-9;  // share of a row
    double row = sign > 0 ? std::floor(from_deg / options_.row_deg + kSame) + 1
                          : std::ceil(from_deg / options_.row_deg - kSame) - 1;
    for (; sign * (to_deg - row * options_.row_deg) > kSame * options_.row_deg; row += sign) {
      if (row == 0) continue;
      add_row(passing(row * options_.row_deg, before, after), Deployment::Event::none);
    }
  }

  // State at this pilot angle, by Newton's method on the integrator's polynomial.
  MotionIntegrator::State passing(double pilot_deg, const MotionIntegrator::State& before,
                                  const MotionIntegrator::State& after) const {
    assert(before.time <= after.time && before.x != after.x);
    const double x = way_.x_of(pilot_deg);
    double time = before.time + (after.time - before.time) * (x - before.x) / (after.x - before.x);
    MotionIntegrator::State state = integrator_.state_at(time);
    for (int k = 0; k < 20 && std::abs(state.x - x) > 1e-15; ++k) {
      const double next = state.rate != 0 ? time - (state.x - x) / state.rate : time;
      if (next == time) break;
      time = std::clamp(next, before.time, after.time);
      state = integrator_.state_at(time);
    }
    return state;
  }

  void add_row(const MotionIntegrator::State& at, Deployment::Event event) {
    const EnergyAt energy = sheet_.at(at.x);
    const double rate = at.rate / unit_s_, moving = kinetic(energy, at.rate);
    run_.rows.push_back({at.time * unit_s_, at.x, rate, way_.pilot_deg(at.x),
                         way_.pilot_rate(at.x) * rate / kRadPerDeg, energy.filling_n_mm, moving,
                         energy.potential + moving, event});
  }

  Deployment end(Outcome outcome) {
    run_.outcome = outcome;
    return std::move(run_);
  }

  const EnergyModel& sheet_;
  const FoldingWay& way_;
  const Deployment::Options& options_;
  const double from_x_, unit_s_;
  int direction_ = -1;
  std::vector<Well> wells_;
  Deployment run_{};
  MotionIntegrator integrator_;
};

}  // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::flat:
      return "flat";
    case Outcome::passed_flat:
      return "passed_flat";
    case Outcome::latched:
      return "latched";
    case Outcome::stalled:
      return "stalled";
    case Outcome::at_rest:
      return "at_rest";
    case Outcome::turned_back:
      return "turned_back";
    case Outcome::fold_limit:
      return "fold_limit";
    case Outcome::time_limit:
      return "time_limit";
    case Outcome::failed:
      break;
  }
  return "failed";
}

Deployment deploy(const EnergyModel& sheet, const std::vector<double>& wells_x,
                  const Deployment::Options& options) {
  if constexpr (has("SUNDIALS")) return Run(sheet, wells_x, options).run();
  throw std::logic_error("built without SUNDIALS, nothing deploys");
}

}  // namespace misalign::solver
