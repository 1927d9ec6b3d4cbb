#include "solver/motion/equilibria.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// A quarter of the distance between stations, from which polynomials show every bend.
constexpr int kPerStation = 4;

// Closer to flat (in x) the potential is symmetric.
constexpr double kFlat = 1e-6;

// Diagonals whose lengths change by no more than this have no equilibria but those of rounding: the
// error of ways is 1e-11 panel widths.
constexpr double kStill_mm = 1e-8;

// Bound of such a filling's change of energy along the way.
double still_n_mm(const EnergyModel& sheet) {
  const Filling& filling = sheet.filling();
  const Eigen::VectorXd& flat_mm = sheet.way().flat_mm();
  return kStill_mm * (filling.forces_n(flat_mm).cwiseAbs().sum() +
                      kStill_mm * filling.stiffness_n_per_mm(flat_mm).cwiseAbs().sum());
}

double root_of_slope(const EnergyModel& sheet, double low, double high) {
  assert(low < high);
  const bool rises = sheet.at(high).slope > 0;
  assert((sheet.at(low).slope > 0) != rises);
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    ((sheet.at(middle).slope > 0) == rises ? high : low) = middle;
  }
  return (low + high) / 2;
}

Equilibrium equilibrium_at(const EnergyModel& sheet, double x, bool is_well) {
  constexpr double kStep = 1e-4;
  const double rate = sheet.way().pilot_rate(x);
  assert(rate > 0 && "the pilot turns where there is an equilibrium");
  const double bend = (sheet.at(x + kStep).slope - sheet.at(x - kStep).slope) / (2 * kStep);
  return {x, sheet.way().pilot_deg(x), sheet.at(x).potential, bend / (rate * rate), is_well};
}

// Energy released on the way from the start to flat, and the joints' turning.
struct Descent {
  double x;
  double filling_n_mm, else_n_mm;  // fall of the filling's energy, and of all else
  double creases_mm, balls;        // integrals of EnergyModel::Turning
};

class DescentToFlat {
 public:
  DescentToFlat(const EnergyModel& sheet, double from_x)
      : sheet_(sheet),
        filling_n_mm_(sheet.filled(from_x).energy),
        else_n_mm_(sheet.all_else(from_x).energy) {
    const int count = kPerStation * static_cast<int>(sheet.way().stations().size());
    path_.push_back({from_x, 0, 0, 0, 0});
    for (int k = 1; k <= count; ++k) {
      path_.push_back(down_to(from_x * (count - k) / count, path_.back()));
    }
  }

  const std::vector<Descent>& path() const { return path_; }

  /// Continues the descent from a place before, by Simpson's rule.
  Descent down_to(double x, const Descent& before) const {
    assert(x <= before.x);
    const auto& [u, v, w] =
        std::tuple(sheet_.turning(before.x), sheet_.turning((x + before.x) / 2), sheet_.turning(x));
    const double sixth = (before.x - x) / 6;
    return {x, filling_n_mm_ - sheet_.filled(x).energy, else_n_mm_ - sheet_.all_else(x).energy,
            before.creases_mm + sixth * (u.creases_mm + 4 * v.creases_mm + w.creases_mm),
            before.balls + sixth * (u.balls + 4 * v.balls + w.balls)};
  }
  /// Rates of all members at the start, per unit of x, downwards.
  Descent at_start() const {
    const double x = path_.front().x;
    const EnergyModel::Turning turning = sheet_.turning(x);
    return {x, sheet_.filled(x).slope, sheet_.all_else(x).slope, turning.creases_mm, turning.balls};
  }

 private:
  const EnergyModel& sheet_;
  const double filling_n_mm_, else_n_mm_;
  std::vector<Descent> path_;
};

struct Least {
  double value, x;
};

// Minimises a quotient over the descent, refined near its minimum.
template <class Quotient>
Least least_over(const DescentToFlat& descent, const Quotient& quotient) {
  const std::vector<Descent>& path = descent.path();
  Least least{quotient(descent.at_start()), path.front().x};
  std::size_t where = 0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    const double value = quotient(path[k]);
    if (value >= least.value) continue;
    least = {value, path[k].x};
    where = k;
  }
  Descent left = path[where > 0 ? where - 1 : 0];
  double right_x = path[std::min(where + 1, path.size() - 1)].x;
  for (int round = 0; round < 4; ++round) {
    constexpr int kParts = 12;
    const double part = (left.x - right_x) / kParts;
    const Descent from = left;
    Descent last = from;
    for (int k = 1; k <= kParts; ++k) {
      const Descent point = descent.down_to(std::max(from.x - k * part, 0.0), last);
      const double value = quotient(point);
      if (value < least.value) {
        least = {value, point.x};
        left = last;
        right_x = std::max(point.x - part, 0.0);
      }
      last = point;
    }
  }
  return least;
}

double stall_of(const EnergyModel& sheet, const std::vector<Descent>& path) {
  const auto is_held = [&](double x) {
    const EnergyAt energy = sheet.at(x);
    return energy.slope <= energy.friction;
  };
  double moves_x = path.front().x;
  if (is_held(moves_x)) return sheet.way().pilot_deg(moves_x);
  for (const Descent& at : path) {
    if (!is_held(at.x)) {
      moves_x = at.x;
      continue;
    }
    double held_x = at.x;
    assert(held_x < moves_x);
    for (int k = 0; k < 50; ++k) {
      const double middle = (held_x + moves_x) / 2;
      (is_held(middle) ? held_x : moves_x) = middle;
    }
    return sheet.way().pilot_deg(held_x);
  }
  return 0;
}

}  // namespace

std::vector<Equilibrium> find_equilibria(const EnergyModel& sheet) {
  const FoldingWay& way = sheet.way();
  const int half = kPerStation * static_cast<int>(way.stations().size());
  std::vector<Equilibrium> equilibria;
  double last_x = 0, last_slope = 0, least_n_mm = 0, most_n_mm = 0;
  // No place is flat itself; both sides of it are sampled.
  for (int k = -half; k < half; ++k) {
    const double x = way.end() * (k + 0.5) / half;
    const EnergyAt energy = sheet.at(x);
    const double slope = energy.slope;
    least_n_mm = k == -half ? energy.potential : std::min(least_n_mm, energy.potential);
    most_n_mm = k == -half ? energy.potential : std::max(most_n_mm, energy.potential);
    if (last_slope * slope < 0) {
      double root = root_of_slope(sheet, last_x, x);
      if (std::abs(root) < kFlat) root = 0;
      equilibria.push_back(equilibrium_at(sheet, root, slope > 0));
    }
    if (slope != 0) last_x = x, last_slope = slope;
  }
  if (most_n_mm - least_n_mm <= still_n_mm(sheet)) equilibria.clear();
  return equilibria;
}

FrictionLimits find_friction_limits(const EnergyModel& sheet, double from_deg) {
  const double from_x = sheet.way().x_of(from_deg);
  assert(from_x > 0);
  const DescentToFlat descent(sheet, from_x);
  const JointResistance& joints = sheet.options().joints;
  FrictionLimits limits;
  const Least critical = least_over(descent, [&](const Descent& at) {
    return (at.filling_n_mm + at.else_n_mm - joints.ball_friction_n_mm * at.balls) / at.creases_mm;
  });
  if (critical.value > 0) {
    limits.critical_n_mm_per_mm = critical.value;
    limits.critical_deg = sheet.way().pilot_deg(critical.x);
  }
  if (joints.friction_n_mm_per_mm <= 0 && joints.ball_friction_n_mm <= 0) return limits;
  limits.static_stall_deg = stall_of(sheet, descent.path());
  const auto* const springs = std::get_if<Springs>(&sheet.options().fill);
  bool springs_drive = springs;
  const Least least = least_over(descent, [&](const Descent& at) {
    springs_drive = springs_drive && at.filling_n_mm > 0;
    return -(joints.friction_n_mm_per_mm * at.creases_mm + joints.ball_friction_n_mm * at.balls -
             at.else_n_mm) /
           at.filling_n_mm;
  });
  if (springs_drive) {
    limits.stiffness_needed_n_per_mm = std::max(-least.value, 0.0) * springs->stiffness_n_per_mm;
  }
  return limits;
}

}  // namespace misalign::solver
