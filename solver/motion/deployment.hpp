// The motion of a released sheet, integrated by SUNDIALS' CVODE (Hindmarsh et al., ACM TOMS
// 31, 2005; Adams' methods) with its events.
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/energy_model.hpp"

namespace misalign::solver {

enum class Outcome {
  flat,         ///< comes to rest flat
  passed_flat,  ///< goes through flat
  latched,      ///< is caught flat
  stalled,      ///< friction holds it elsewhere
  at_rest,      ///< comes to rest in a well of its energy that is not flat
  turned_back,  ///< turns back, and nothing slows it down
  fold_limit,   ///< folds as far as the path goes
  time_limit,   ///< still moves
  failed        ///< the integrator gave up: a numerical failure
};
const char* name_of(Outcome outcome);

struct Deployment {
  struct Options {
    double from_deg = 36;  ///< angle of release; the paper's "20 % folded"
    bool latch = false;    ///< true: it is caught when it first is flat
    /// The coefficient of restitution of a stop at flat, from 0 to less than 1: the sheet leaves it
    /// with this share of its speed.
    std::optional<double> restitution{};
    /// The number of times that the sheet may pass flat or, where nothing slows it down, turn back
    /// before the run ends.
    int swings = 0;
    double time_limit_s = 60;
    double row_deg = 0.5;   ///< rows are at its multiples, and at each event
    double flat_deg = 0.5;  ///< a sheet that rests this close to flat is flat
    /// The sheet is at a well that is not flat when it is this close. It is at rest when its energy
    /// takes it no farther than well_deg or flat_deg from the nearest well.
    double well_deg = 0.01;
    double relative_tolerance = 1e-11;  ///< tolerance of the integration
  };

  enum class Event { none, start, flat, turn, end };

  struct Row {
    double time_s, x, x_rate;  ///< x_rate in rad/s
    double pilot_deg, rate_deg_per_s;
    double springs_n_mm, kinetic_n_mm, total_n_mm;
    Event event;
  };

  Outcome outcome;
  std::vector<Row> rows;  ///< first: release at from_deg; last: the end
  int passes = 0, turns = 0, bounces = 0, steps = 0;

  const Row& last() const { return rows.back(); }
};

/// The way of `sheet` must reach beyond from_deg. `wells_x` are the minima of its potential
/// (find_wells). The build must have SUNDIALS.
Deployment deploy(const EnergyModel& sheet, const std::vector<double>& wells_x,
                  const Deployment::Options& options);

}  // namespace misalign::solver
