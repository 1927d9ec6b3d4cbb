#include "solver/fitting/spring_program.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "solver/linear/simplex.hpp"
#include "solver/motion/energy_model.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPlacesPerStation = 8;
// The first rows are a fixed share of the places.
constexpr std::size_t kFirstRows = 16;
// Rows are added until the springs' friction reaches the program's, to this share of its unit.
constexpr double kRowsWithin = 1e-9;
constexpr int kMostRounds = 60;
// Rates of lengths (mm per rad) that are rounding of the way, 1e-11 panel widths in a length.
constexpr double kStillRate_mm = 1e-8;

// Two columns of a program: a spring's parts with its least and its most free length, and of the
// rate that it must have, the part with the most free length.
struct SpringColumns {
  Index diagonal;
  Index within = -1, least = -1, most = -1;
};

// A program of some rows: friction = offset + unit * (the last variable).
struct FrictionProgram {
  LinearProgram linear;
  std::vector<SpringColumns> columns;
  double rate = 1, unit = 1, offset = 0;
};

std::vector<SpringColumns> columns_of(const std::vector<SpringRange>& springs, Index& count) {
  std::vector<SpringColumns> columns;
  count = 0;
  for (Index d = 0; d < std::ssize(springs); ++d) {
    const SpringRange& spring = springs[static_cast<std::size_t>(d)];
    if (spring.most_n_per_mm <= 0) continue;
    const bool varies = spring.most_free_mm > spring.least_free_mm;
    SpringColumns column{d};
    if (spring.least_n_per_mm > 0 && varies) column.within = count++;
    if (spring.most_n_per_mm > spring.least_n_per_mm) {
      column.least = count++;
      if (varies) column.most = count++;
    }
    columns.push_back(column);
  }
  return columns;
}

// Friction at a place per rate of a spring.
double gain(const DrivenPlace& place, Index d, double free_mm) {
  return (place.length_mm(d) - free_mm) * place.slope_mm(d) / place.turning_mm;
}

// Friction of the rates that springs must have, at their least free lengths.
double given(const DrivenPlace& place, const std::vector<SpringRange>& springs) {
  double sum = 0;
  for (Index d = 0; d < std::ssize(springs); ++d) {
    const SpringRange& spring = springs[static_cast<std::size_t>(d)];
    sum += spring.least_n_per_mm * gain(place, d, spring.least_free_mm);
  }
  return sum;
}

// Coefficients of a place's row: friction per unit of each variable.
VectorXd gains_of(const DrivenPlace& place, const std::vector<SpringRange>& springs,
                  const FrictionProgram& program, Index variables) {
  VectorXd gains = VectorXd::Zero(variables);
  for (const SpringColumns& column : program.columns) {
    const SpringRange& spring = springs[static_cast<std::size_t>(column.diagonal)];
    const double low = gain(place, column.diagonal, spring.least_free_mm);
    const double high = gain(place, column.diagonal, spring.most_free_mm);
    if (column.within >= 0) gains(column.within) = program.rate * (high - low);
    if (column.least >= 0) gains(column.least) = program.rate * low;
    if (column.most >= 0) gains(column.most) = program.rate * high;
  }
  return gains;
}

// Rows of the springs' own limits, and of the groups, below those of the places.
void add_limits(const std::vector<SpringRange>& springs, const std::vector<SpringGroup>& groups,
                const VectorXd& largest_n_per_mm, Index row, FrictionProgram& program) {
  LinearProgram& linear = program.linear;
  std::vector<const SpringColumns*> columns(springs.size(), nullptr);
  for (const SpringColumns& column : program.columns) {
    const SpringRange& spring = springs[static_cast<std::size_t>(column.diagonal)];
    columns[static_cast<std::size_t>(column.diagonal)] = &column;
    if (column.within >= 0) {
      linear.rows(row, column.within) = 1;
      linear.bounds(row++) = spring.least_n_per_mm / program.rate;
    }
    if (column.least < 0) continue;
    linear.rows(row, column.least) = 1;
    if (column.most >= 0) linear.rows(row, column.most) = 1;
    linear.bounds(row++) = (spring.most_n_per_mm - spring.least_n_per_mm) / program.rate;
  }
  for (const SpringGroup& group : groups) {
    double left = group.most;
    for (const int d : group.diagonals) {
      const SpringRange& spring = springs[static_cast<std::size_t>(d)];
      left -= spring.least_n_per_mm / largest_n_per_mm(d);
      const SpringColumns* const column = columns[static_cast<std::size_t>(d)];
      if (!column || column->least < 0) continue;
      linear.rows(row, column->least) = program.rate / largest_n_per_mm(d);
      if (column->most >= 0) linear.rows(row, column->most) = program.rate / largest_n_per_mm(d);
    }
    linear.bounds(row++) = std::max(left, 0.0);
  }
  assert(row == linear.rows.rows());
}

FrictionProgram friction_program(const std::vector<const DrivenPlace*>& rows,
                                 const std::vector<SpringRange>& springs,
                                 const std::vector<SpringGroup>& groups,
                                 const VectorXd& largest_n_per_mm) {
  FrictionProgram program;
  Index variables = 0;
  program.columns = columns_of(springs, variables);
  program.rate = std::max(largest_n_per_mm.maxCoeff(), 1e-300);
  const Index count = std::ssize(rows);
  Eigen::MatrixXd gains(count, variables);
  VectorXd givens(count);
  for (Index r = 0; r < count; ++r) {
    const DrivenPlace& place = *rows[static_cast<std::size_t>(r)];
    gains.row(r) = gains_of(place, springs, program, variables);
    givens(r) = given(place, springs);
  }
  program.offset = givens.minCoeff();
  const double largest =
      std::max(variables > 0 ? gains.cwiseAbs().maxCoeff() : 0.0, givens.cwiseAbs().maxCoeff());
  program.unit = largest > 0 ? largest : 1;
  Index limits = std::ssize(groups);
  for (const SpringColumns& column : program.columns) {
    limits += (column.within >= 0 ? 1 : 0) + (column.least >= 0 ? 1 : 0);
  }
  LinearProgram& linear = program.linear;
  linear.rows.setZero(count + limits, variables + 1);
  linear.bounds.setZero(count + limits);
  linear.gain = VectorXd::Unit(variables + 1, variables);
  linear.rows.topLeftCorner(count, variables) = -gains / program.unit;
  linear.rows.topRightCorner(count, 1).setOnes();
  linear.bounds.head(count) = (givens.array() - program.offset) / program.unit;
  add_limits(springs, groups, largest_n_per_mm, count, program);
  return program;
}

ProgrammedSprings springs_of(const FrictionProgram& program, const LinearOptimum& optimum,
                             const std::vector<SpringRange>& springs) {
  ProgrammedSprings found;
  found.rates_n_per_mm.setZero(std::ssize(springs));
  found.free_mm.resize(std::ssize(springs));
  for (Index d = 0; d < found.free_mm.size(); ++d) {
    found.free_mm(d) = springs[static_cast<std::size_t>(d)].least_free_mm;
  }
  for (const SpringColumns& column : program.columns) {
    const SpringRange& spring = springs[static_cast<std::size_t>(column.diagonal)];
    const auto part = [&](Index at) { return at < 0 ? 0.0 : program.rate * optimum.x(at); };
    const double long_ones = part(column.within) + part(column.most);
    const double rate = std::min(spring.least_n_per_mm + part(column.least) + part(column.most),
                                 spring.most_n_per_mm);
    // A rate that is rounding is none.
    if (rate <= 1e-12 * program.rate) continue;
    found.rates_n_per_mm(column.diagonal) = rate;
    found.free_mm(column.diagonal) +=
        std::min(long_ones / rate, 1.0) * (spring.most_free_mm - spring.least_free_mm);
  }
  found.bound_n_mm_per_mm = program.offset + program.unit * optimum.value;
  return found;
}

// Vertex of the parabola through three points; none where it is no minimum between them.
std::optional<double> vertex(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
  const double left = (y(1) - y(0)) / (x(1) - x(0)), right = (y(2) - y(1)) / (x(2) - x(1));
  const double bend = (right - left) / (x(2) - x(0));
  if (bend <= 0) return {};
  const double at = (x(0) + x(1)) / 2 - left / (2 * bend);
  if (at <= x(0) || at >= x(2)) return {};
  return at;
}

}  // namespace

SpringProgram::SpringProgram(const FoldingWay& way, double from_deg, double to_deg)
    : way_(way), crease_mm_(crease_lengths_mm(way)) {
  const double from_x = way.x_of(from_deg), to_x = way.x_of(to_deg);
  assert(0 < to_x && to_x < from_x);
  const double step = way.end() / static_cast<double>(way.stations().size()) / kPlacesPerStation;
  const int count = std::max(2, static_cast<int>(std::ceil((from_x - to_x) / step)));
  for (int k = 0; k <= count; ++k) places_.push_back(place_at(to_x + (from_x - to_x) * k / count));
  for (std::size_t k = 0; k < places_.size(); ++k) {
    places_[k].is_row = k % kFirstRows == 0 || k + 1 == places_.size();
  }
}

DrivenPlace SpringProgram::place_at(double x) const {
  DrivenPlace place{x, way_.pilot_deg(x), {}, {}, 0, false};
  way_.find_lengths(x, place.length_mm, place.slope_mm);
  place.slope_mm = (place.slope_mm.array().abs() > kStillRate_mm).select(place.slope_mm, 0);
  VectorXd angles_rad, rates;
  way_.find_creases(x, angles_rad, rates);
  place.turning_mm = crease_mm_.dot(rates.cwiseAbs());
  assert(place.turning_mm > 0);
  return place;
}

double SpringProgram::overcome(const DrivenPlace& place, const VectorXd& rates_n_per_mm,
                               const VectorXd& free_mm) {
  const VectorXd forces_n = rates_n_per_mm.cwiseProduct(place.length_mm - free_mm);
  return forces_n.dot(place.slope_mm) / place.turning_mm;
}

// Makes rows of the local minima of the friction that lie below a number, and of those between
// places.
bool SpringProgram::add_rows(const ProgrammedSprings& springs, double below) {
  VectorXd overcome_at(std::ssize(places_));
  for (Index k = 0; k < overcome_at.size(); ++k) {
    overcome_at(k) =
        overcome(places_[static_cast<std::size_t>(k)], springs.rates_n_per_mm, springs.free_mm);
  }
  bool is_added = false;
  std::vector<DrivenPlace> between;
  const Index last = overcome_at.size() - 1;
  for (Index k = 0; k <= last; ++k) {
    const double left = overcome_at(std::max<Index>(k - 1, 0));
    const double right = overcome_at(std::min(k + 1, last));
    if (overcome_at(k) > left || overcome_at(k) > right) continue;
    DrivenPlace& place = places_[static_cast<std::size_t>(k)];
    if (overcome_at(k) < below && !place.is_row) place.is_row = is_added = true;
    if (k == 0 || k == last) continue;
    const Eigen::Vector3d x(places_[static_cast<std::size_t>(k - 1)].x, place.x,
                            places_[static_cast<std::size_t>(k + 1)].x);
    const std::optional<double> lowest = vertex(x, overcome_at.segment<3>(k - 1));
    if (!lowest) continue;
    DrivenPlace other = place_at(*lowest);
    if (overcome(other, springs.rates_n_per_mm, springs.free_mm) >= below) continue;
    other.is_row = is_added = true;
    between.push_back(std::move(other));
  }
  for (DrivenPlace& place : between) {
    const auto at = std::ranges::lower_bound(places_, place.x, {}, &DrivenPlace::x);
    places_.insert(at, std::move(place));
  }
  return is_added;
}

ProgrammedSprings SpringProgram::solve(const std::vector<SpringRange>& springs,
                                       const std::vector<SpringGroup>& groups,
                                       const VectorXd& largest_n_per_mm) {
  assert(largest_n_per_mm.size() == std::ssize(springs));
  ProgrammedSprings found;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<const DrivenPlace*> rows;
    for (const DrivenPlace& place : places_) {
      if (place.is_row) rows.push_back(&place);
    }
    const FrictionProgram program = friction_program(rows, springs, groups, largest_n_per_mm);
    const LinearOptimum optimum = maximize(program.linear);
    ++programs_;
    pivots_ += optimum.pivots;
    found = springs_of(program, optimum, springs);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double weight = optimum.price(static_cast<Index>(r));
      if (weight > 0) found.weights.push_back({rows[r]->pilot_deg, weight});
    }
    const double close =
        kRowsWithin * std::max(std::abs(found.bound_n_mm_per_mm), 1e-3 * program.unit);
    if (!add_rows(found, found.bound_n_mm_per_mm - close)) break;
  }
  found.static_n_mm_per_mm = std::numeric_limits<double>::infinity();
  for (const DrivenPlace& place : places_) {
    const double friction = overcome(place, found.rates_n_per_mm, found.free_mm);
    if (friction >= found.static_n_mm_per_mm) continue;
    found.static_n_mm_per_mm = friction;
    found.weakest_deg = place.pilot_deg;
  }
  return found;
}

}  // namespace misalign::solver
