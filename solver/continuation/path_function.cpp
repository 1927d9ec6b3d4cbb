#include "solver/continuation/path_function.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// The pilot is the variable while its rate is at least this share of the fastest crease's.
constexpr double kFastEnough = 0.6;

// Errors of a solved point's length, and per radian of the segment and unit of the tangent's
// misfit.
constexpr double kNodeError_widths = 1e-11, kErrorPerMisfit = 10;

}  // namespace

PathFunction::Node::Node(const Mechanism& mechanism)
    : creases(mechanism.creases.size()),
      crease_rates(mechanism.creases.size()),
      lengths(mechanism.diagonals.size()),
      slopes(mechanism.diagonals.size()) {}

PathFunction::Node::~Node() = default;
PathFunction::Node::Node(const Node&) = default;
PathFunction::Node::Node(Node&&) = default;
PathFunction::Node& PathFunction::Node::operator=(Node&&) = default;

PathFunction::Estimate::Estimate(const Mechanism& mechanism)
    : lengths(mechanism.diagonals.size()), length_errors(lengths), slopes(lengths) {}

PathFunction::Estimate::~Estimate() = default;

PathFunction::PathFunction(const Mechanism& mechanism)
    : mechanism_(mechanism),
      pilot_(mechanism.pilot),
      diagonals_(mechanism.diagonal_count()),
      nodes_(kNodes + 1, Node(mechanism)),
      flat_(mechanism.diagonals.size()),
      values_(mechanism.diagonals.size() + 1),
      rates_(values_),
      scratch_(flat_),
      table_(mechanism.diagonal_count() + 1, kNodes + 1) {}

PathFunction::~PathFunction() = default;
PathFunction::PathFunction(const PathFunction&) = default;
PathFunction::PathFunction(PathFunction&&) = default;

void PathFunction::begin(const double* flat_lengths) {
  count_ = 0;
  std::copy_n(flat_lengths, diagonals_, flat_.begin());
  variable_ = pilot_;
  sign_ = mechanism_.creases[pilot_].assignment;
}

int PathFunction::kept() const { return std::min(count_, kNodes); }

void PathFunction::add() {
  ++count_;
  inside_ = 0;
  renew();
}

void PathFunction::add_at_turn() {
  if (inside_ > 0) {
    std::swap(nodes_[place(-1)], nodes_[place(0)]);  // too close to each other for one table
  } else {
    ++count_;
    inside_ = 1;
  }
  renew();
}

void PathFunction::renew() {
  assert(kept() > inside_);
  choose_variable();
  find_angles();
  from_ = count_ > inside_ + 1 ? at_[inside_ + 1] : 0;
  make_table();
  located_x_ = from_;
  located_rad_ = table_.value_and_rate(diagonals_, from_, located_slope_);
  end_ = turns() ? turning_point() : to();
}

void PathFunction::drop() {
  assert(count_ > 0);
  --count_;
  inside_ = std::max(inside_ - 1, 0);
  find_angles();
}

// Computes each node's angle once, unless the variable changes.
void PathFunction::find_angles() {
  for (int k = 0; k < kept(); ++k) {
    Node& point = nodes_[place(k)];
    if (point.angle_of != variable_) {
      point.angle_of = variable_;
      point.angle_rad = angle_rad(point.creases[variable_]);
    }
    at_[k] = sign_ * point.angle_rad;
  }
}

void PathFunction::choose_variable() {
  const std::vector<double>& rates = node(0).crease_rates;
  double fastest = 0;
  int candidate = pilot_;
  for (std::size_t k = 0; k < rates.size(); ++k) {
    double least = std::abs(rates[k]);
    if (least <= fastest) continue;
    // The variable must turn in the same direction at all nodes.
    for (int i = 1; i < kept(); ++i) {
      if (node(i).crease_rates[k] * rates[k] <= 0) least = 0;
    }
    if (least <= fastest) continue;
    fastest = least;
    candidate = static_cast<int>(k);
  }
  const double now = sign_ * rates[variable_];
  if (count_ < kNodes || now >= kFastEnough * fastest) return;
  variable_ = candidate;
  sign_ = rates[candidate] < 0 ? -1 : 1;
}

void PathFunction::make_table() {
  table_.begin();
  for (int k = 0; k < kept(); ++k) {
    const Node& point = node(k);
    const double per_rate = 1 / variable_rate(k);
    std::copy(point.lengths.begin(), point.lengths.end(), values_.begin());
    values_.back() = variable_ == pilot_ ? at_[k] : angle_rad(point.creases[pilot_]);
    for (int d = 0; d < diagonals_; ++d) rates_[d] = point.slopes[d] * per_rate;
    rates_.back() = point.crease_rates[pilot_] * per_rate;
    table_.add(at_[k], values_.data(), rates_.data());
  }
  if (from_flat()) {
    std::copy(flat_.begin(), flat_.end(), values_.begin());
    std::fill(rates_.begin(), rates_.end(), 0.0);
    values_.back() = 0;
    rates_.back() = 1;
    is_even() ? table_.add(0, values_.data(), rates_.data()) : table_.add_value(0, values_.data());
  }
  table_.finish();
}

double PathFunction::roughness() const { return table_.largest_last_terms(0.5 * (from() + to())); }

double PathFunction::pilot(double x) const {
  return variable_ == pilot_ ? x : table_.value(diagonals_, x);
}

double PathFunction::pilot_slope(double x) const {
  return variable_ == pilot_ ? 1 : table_.rate(diagonals_, x);
}

double PathFunction::pilot_error(double x) const {
  return variable_ == pilot_ ? 0 : pilot_error(x, table_.largest_last_terms(x));
}

// The largest of all last terms counts, since the pilot's own may vanish by accident.
double PathFunction::pilot_error(double x, double largest_of_lengths) const {
  if (variable_ == pilot_) return 0;
  return kFunctionSafety * std::max(largest_of_lengths, table_.last_terms(diagonals_, x)) + 1e-14;
}

double PathFunction::pilot_rise() const {
  const double rate = pilot_slope(at_[0]);
  return 0.5 * rate * rate / std::abs(table_.second_rate(diagonals_, at_[0]));
}

// Uses Newton's method in a bracket, starting from the last result, since samples are neighbours.
double PathFunction::locate(double pilot_rad) const {
  assert(kept() > 0);
  if (variable_ == pilot_) return pilot_rad;
  double low = at_[kept() - 1], high = end();
  double x = located_x_ + (pilot_rad - located_rad_) / located_slope_;
  for (int k = 0; k < 60; ++k) {
    if (!(x > low && x < high)) x = 0.5 * (low + high);
    double slope;
    const double off = table_.value_and_rate(diagonals_, x, slope) - pilot_rad;
    (off > 0 ? high : low) = x;
    const double step = off / slope;
    located_rad_ = pilot_rad + off;
    located_x_ = x;
    located_slope_ = slope;
    x -= step;
    if (std::abs(step) < 1e-14) break;
  }
  return x;
}

bool PathFunction::pilot_goes_on() const {
  if (variable_ == pilot_) return true;
  constexpr int kParts = 10;
  const double last = end();
  // A slope's error next to the segment's end is several times the value's error divided by the
  // length.
  const double room = kParts * pilot_error(0.5 * (from() + to())) / (to() - from());
  for (int k = 0; k < kParts; ++k) {
    const double left =
        1 - static_cast<double>(k) / kParts;  // the slope falls to zero near the turn
    const double x = last + (from() - last) * left;
    if (pilot_slope(x) <= (turns() ? room * left : room)) return false;
  }
  return true;
}

double PathFunction::turning_point() const {
  double low = from(), high = to();
  for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
    const double middle = 0.5 * (low + high);
    (pilot_slope(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double PathFunction::node_error() const {
  return kNodeError_widths + kErrorPerMisfit * node(0).misfit * (to() - from());
}

void PathFunction::find_lengths(double x, std::vector<double>& lengths,
                                std::vector<double>& errors) const {
  assert(std::ssize(lengths) == diagonals_ && std::ssize(errors) == diagonals_);
  if (variable_ == pilot_) {
    table_.find_values(x, diagonals_, lengths.data(), errors.data());
    const double all =
        kFunctionSafety * *std::max_element(errors.begin(), errors.end()) + node_error();
    std::fill(errors.begin(), errors.end(), all);
    return;
  }
  table_.look(x, diagonals_, lengths.data(), scratch_.data(), errors.data());
  const double largest = *std::max_element(errors.begin(), errors.end());
  const double off = pilot_error(x, largest) / pilot_slope(x);
  for (int d = 0; d < diagonals_; ++d) {
    errors[d] = kFunctionSafety * largest + node_error() + std::abs(scratch_[d]) * off;
  }
}

void PathFunction::look(double x, Estimate& estimate) const {
  table_.look(x, diagonals_, estimate.lengths.data(), estimate.slopes.data(),
              estimate.length_errors.data());
  const double largest =
      *std::max_element(estimate.length_errors.begin(), estimate.length_errors.end());
  const double per_slope = 1 / pilot_slope(x), off = pilot_error(x, largest) * per_slope;
  const double all = kFunctionSafety * largest;
  for (int d = 0; d < diagonals_; ++d) {
    estimate.length_errors[d] = all + std::abs(estimate.slopes[d]) * off + node_error();
    estimate.slopes[d] *= per_slope;
  }
}

double PathFunction::slope(int diagonal, double x) const {
  assert(diagonal >= 0 && diagonal < diagonals_);
  return table_.rate(diagonal, x) / pilot_slope(x);
}

bool PathFunction::creases_are_clear() const {
  // A cubic deviates from its chord by at most 4/27 of its end slopes' deviation times its length;
  // twice that for functions that are not cubic.
  constexpr double kRoom = 8.0 / 27;
  const Node& next = node(inside_);
  const double step = to() - from(), next_rate = 0.5 / variable_rate(inside_);
  const int before = inside_ + 1;
  const bool is_first = count_ == before;
  const double last_rate = is_first ? 0 : 0.5 / variable_rate(before);
  for (std::size_t k = 0; k < next.creases.size(); ++k) {
    const int assignment = mechanism_.creases[k].assignment;
    const HalfAngle<double> a = is_first ? HalfAngle<double>{1, 0} : node(before).creases[k];
    const HalfAngle<double>& b = next.creases[k];
    const double turn_a = is_first ? 0 : node(before).crease_rates[k] * last_rate;
    const double turn_b = next.crease_rates[k] * next_rate;
    const auto is_clear = [&](double at_a, double at_b, double rate_a, double rate_b) {
      const double chord = (at_b - at_a) / step;
      const double room = kRoom * step * (std::abs(rate_a - chord) + std::abs(rate_b - chord));
      return std::min(at_a, at_b) > room + 1e-9;
    };
    if (!is_clear(a.c, b.c, -a.s * turn_a, -b.s * turn_b)) return false;
    if (is_first) {
      if (!(b.s * assignment > 1e-9)) return false;
      continue;
    }
    if (!is_clear(a.s * assignment, b.s * assignment, a.c * turn_a * assignment,
                  b.c * turn_b * assignment)) {
      return false;
    }
  }
  return true;
}

double PathFunction::find_creases(double x, std::vector<HalfAngle<double>>& creases) const {
  assert(creases.size() == mechanism_.creases.size());
  double nodes[kNodes], of_values[kNodes], of_rates[kNodes], fewer_values[kNodes],
      fewer_rates[kNodes];
  const int count = kept();
  for (int k = 0; k < count; ++k) nodes[k] = at_[k];
  hermite_weights(nodes, count, nullptr, x, of_values, of_rates, nullptr);
  hermite_weights(nodes, count - 1, nullptr, x, fewer_values, fewer_rates, nullptr);
  fewer_values[count - 1] = fewer_rates[count - 1] = 0;
  double error = 0;
  for (std::size_t i = 0; i < creases.size(); ++i) {
    HalfAngle<double> all{0, 0}, fewer{0, 0};
    for (int k = 0; k < count; ++k) {
      const HalfAngle<double>& rho = node(k).creases[i];
      const double half_rate = 0.5 * node(k).crease_rates[i] / variable_rate(k);
      const double c_rate = -rho.s * half_rate, s_rate = rho.c * half_rate;
      all.c += of_values[k] * rho.c + of_rates[k] * c_rate;
      all.s += of_values[k] * rho.s + of_rates[k] * s_rate;
      fewer.c += fewer_values[k] * rho.c + fewer_rates[k] * c_rate;
      fewer.s += fewer_values[k] * rho.s + fewer_rates[k] * s_rate;
    }
    creases[i] = all;
    error = std::max({error, std::abs(all.c - fewer.c), std::abs(all.s - fewer.s)});
  }
  return error + kNodeError_widths;
}

}  // namespace misalign::solver
