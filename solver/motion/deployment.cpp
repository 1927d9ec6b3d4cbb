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

// Springs that are off by less than this are relaxed: lengths are known to 1e-10 mm.
constexpr double kRelaxed_mm = 1e-8;

// Time is counted in units of the sheet's own, in which the way takes about 1.
double time_unit_s(const EnergyModel& sheet, double from_x, const std::vector<double>& wells_x) {
  const EnergyAt start = sheet.at(from_x);
  double released = std::abs(start.potential - sheet.at(0).potential);
  for (const double x : wells_x) {
    released = std::max(released, start.potential - sheet.at(x).potential);
  }
  if (!(released > 0)) return 1;
  return std::abs(from_x) * std::sqrt(start.mass / (2 * released));
}

// As close as this to where friction holds it, it is there.
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
    const EnergyAt here = sheet_.at(x);
    const double speed = rate / unit_s_;  // per second
    assert(here.mass > 0);
    const double force = -here.mass_slope * speed * speed / 2 - here.slope -
                         direction_ * here.friction - here.damping * speed;
    return unit_s_ * unit_s_ * force / here.mass;
  }

  // What a stop means; nothing where the motion goes on.
  std::optional<Outcome> after(Stop stop) {
    const MotionIntegrator::State here = integrator_.state();
    switch (stop) {
      case Stop::at_zero:
        add_row(here, Deployment::Event::flat);
        if (options_.latch) return Outcome::latched;
        if (options_.restitution) return bounced(here);
        if (++run_.passes > options_.swings) return Outcome::passed_flat;
        return {};
      case Stop::at_rest:
        add_row({here.time, here.x, 0}, Deployment::Event::turn);
        ++run_.turns;
        if (is_held(here.x)) return held_at(here.x);
        if (!loses_energy() && run_.turns > options_.swings) {
          return Outcome::turned_back;
        }
        set_off({here.time, here.x, 0});
        return {};
      case Stop::at_end:
        add_row(here, Deployment::Event::end);
        return Outcome::fold_limit;
      case Stop::at_time:
        add_row(here, Deployment::Event::end);
        return Outcome::time_limit;
      case Stop::step:
      case Stop::failed:
        break;
    }
    return at_rest(here);
  }

  bool loses_energy() const { return sheet_.options().joints.slows_down() || options_.restitution; }

  // By a stop at flat; there it stays if what is left does not take it out of flat's neighbourhood.
  std::optional<Outcome> bounced(const MotionIntegrator::State& here) {
    assert(*options_.restitution >= 0 && *options_.restitution < 1);
    const MotionIntegrator::State back{here.time, 0, -*options_.restitution * here.rate};
    const EnergyAt flat = sheet_.at(0), beside = sheet_.at(way_.x_of(options_.flat_deg));
    if (flat.potential + kinetic(flat, back.rate) <= beside.potential) {
      add_row({here.time, 0, 0}, Deployment::Event::end);
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

  // At rest there: by friction, or since nothing drives it.
  bool is_held(double x) const {
    const EnergyAt here = sheet_.at(x);
    const bool relaxed =
        std::sqrt(2 * sheet_.unit_springs(x).energy) < kRelaxed_mm && sheet_.all_else(x).slope == 0;
    return relaxed || std::abs(here.slope) <= here.friction;
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

  // A well, and the energy with which its neighbourhood is left.
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

  // Friction will hold it before it has gone on by kCreep_deg: it would come to rest there in no
  // time, or creep for ever.
  bool creeps_to_rest(const MotionIntegrator::State& here, const EnergyAt& now) const {
    if (now.friction <= 0 || here.rate == 0) return false;
    const double ahead_x =
        here.x +
        std::copysign(kCreep_deg / std::abs(way_.pilot_rate(here.x) / kRadPerDeg), here.rate);
    if (std::abs(ahead_x) >= way_.end() || ahead_x * here.x <= 0) return false;
    const EnergyAt ahead = sheet_.at(ahead_x);
    if (std::abs(ahead.slope) > ahead.friction) return false;  // it turns round there
    const double lost = (now.friction + ahead.friction) / 2 * std::abs(ahead_x - here.x);
    return now.potential + kinetic(now, here.rate) - ahead.potential < lost;
  }

  // In the nearest well, without the energy to leave its neighbourhood; or next to where friction
  // holds it.
  std::optional<Outcome> at_rest(const MotionIntegrator::State& here) {
    if (!sheet_.options().joints.slows_down()) return {};
    if (creeps_to_rest(here, sheet_.at(here.x))) {
      add_row({here.time, here.x, 0}, Deployment::Event::end);
      return held_at(here.x);
    }
    if (wells_.empty()) return {};
    const Well& well =
        *std::min_element(wells_.begin(), wells_.end(), [&](const Well& a, const Well& b) {
          return std::abs(here.x - a.x) < std::abs(here.x - b.x);
        });
    const EnergyAt now = sheet_.at(here.x);
    if (now.potential + kinetic(now, here.rate) > well.edge) return {};
    add_row(here, Deployment::Event::end);
    return held_at(here.x);
  }

  double kinetic(const EnergyAt& here, double rate) const {
    return here.mass / 2 * (rate / unit_s_) * (rate / unit_s_);
  }

  // At the multiples of row_deg that were passed; between two stops x goes one way.
  void add_rows_between(const MotionIntegrator::State& before,
                        const MotionIntegrator::State& after) {
    const double from_deg = way_.pilot_deg(before.x), to_deg = way_.pilot_deg(after.x);
    const int sign = to_deg > from_deg ? 1 : -1;
    constexpr double kSame = 1e-9;  // of a row
    double row = sign > 0 ? std::floor(from_deg / options_.row_deg + kSame) + 1
                          : std::ceil(from_deg / options_.row_deg - kSame) - 1;
    for (; sign * (to_deg - row * options_.row_deg) > kSame * options_.row_deg; row += sign) {
      if (row == 0) continue;
      add_row(passing(row * options_.row_deg, before, after), Deployment::Event::none);
    }
  }

  // When the pilot has this angle: by Newton's method on the integrator's own polynomial.
  MotionIntegrator::State passing(double pilot_deg, const MotionIntegrator::State& before,
                                  const MotionIntegrator::State& after) const {
    assert(before.time <= after.time && before.x != after.x);
    const double x = way_.x_of(pilot_deg);
    double time = before.time + (after.time - before.time) * (x - before.x) / (after.x - before.x);
    MotionIntegrator::State here = integrator_.state_at(time);
    for (int k = 0; k < 20 && std::abs(here.x - x) > 1e-15; ++k) {
      const double next = here.rate != 0 ? time - (here.x - x) / here.rate : time;
      if (next == time) break;
      time = std::clamp(next, before.time, after.time);
      here = integrator_.state_at(time);
    }
    return here;
  }

  void add_row(const MotionIntegrator::State& at, Deployment::Event event) {
    const EnergyAt here = sheet_.at(at.x);
    const double rate = at.rate / unit_s_, moving = kinetic(here, at.rate);
    run_.rows.push_back({at.time * unit_s_, at.x, rate, way_.pilot_deg(at.x),
                         way_.pilot_rate(at.x) * rate / kRadPerDeg, here.springs_n_mm, moving,
                         here.potential + moving, event});
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
