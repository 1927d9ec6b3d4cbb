#include "solver/judging/extreme_finder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "solver/verdict/between.hpp"

namespace misalign::solver {
namespace {

// Longest step of a reversal by its exact slope, and the step below which it is certain: curvatures
// are known to a tenth.
constexpr double kLongestReversalStep_rad = 1e-3, kSureReversalStep_rad = 3e-8;

// A diagonal on a part of the newest segment.
struct Subsegment {
  const PathFunction& function;
  int diagonal, direction;
  double from, to;  // values of the function's variable

  double slope(double x) const { return direction * function.slope(diagonal, x); }
  double root_of_slope(double high) const;
  double least_slope_at() const;
};

// Root of the slope between the subsegment's start, where it is positive, and `high`, where it is
// not.
double Subsegment::root_of_slope(double high) const {
  double low = from;
  for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Place of the least slope, if it has one minimum (golden section).
double Subsegment::least_slope_at() const {
  constexpr double kGolden = 0.6180339887498949;
  double low = from, high = to;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = slope(a), at_b = slope(b);
  for (int k = 0; k < 30; ++k) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = slope(a = high - kGolden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = slope(b = low + kGolden * (high - low));
    }
  }
  return 0.5 * (low + high);
}

// Returns whether an even length, a rho^2 + b rho^4 next to flat, starts in reverse: the term a
// rho^2 at the first sample (panel widths), where a diagonal has moved by `on` and has the slope
// `slope`, is negative by more than the error of rates of change.
bool sets_out_back_at_flat(double on, double slope, double pilot_rad) {
  return 2 * on - slope * pilot_rad / 2 < -kBumpBand_widths;
}

}  // namespace

double goes_back_from_deg(const PathFunction& function, int diagonal, int direction,
                          double from_deg, double to_deg) {
  const Subsegment subsegment{function, diagonal, direction, function.locate(from_deg * kRadPerDeg),
                              function.locate(to_deg * kRadPerDeg)};
  const double root = subsegment.root_of_slope(subsegment.least_slope_at());
  return function.pilot(root) / kRadPerDeg;
}

std::optional<double> ReversalSecants::next_deg(const std::vector<double>& slopes) {
  const double slope = slopes[static_cast<std::size_t>(reversal_.diagonal)];
  if (step_rad_ != 0) reversal_.curvature = (slope - slope_) / step_rad_;
  const double step_rad = -slope / reversal_.curvature;
  if (!(std::abs(step_rad) <= kLongestReversalStep_rad)) return std::nullopt;
  reversal_.pilot_deg += step_rad / kRadPerDeg;
  step_rad_ = step_rad;
  slope_ = slope;
  is_sure_ = std::abs(step_rad) <= kSureReversalStep_rad;
  if (is_sure_) return std::nullopt;
  return reversal_.pilot_deg;
}

double ReversalSecants::slope_error() const {
  return std::abs(reversal_.curvature) * kSureReversalStep_rad;
}

ExtremeFinder::ExtremeFinder(int diagonals)
    : last_(static_cast<std::size_t>(diagonals)), last_slopes_(last_), back_since_deg_(last_) {}

ExtremeFinder::~ExtremeFinder() = default;
ExtremeFinder::ExtremeFinder(const ExtremeFinder&) = default;

void ExtremeFinder::begin(const std::vector<double>& flat_lengths) {
  extremes_ = {};
  least_slope_ = {};
  reversal_ = {};
  last_deg_ = 0;
  last_ = flat_lengths;
  std::fill(last_slopes_.begin(), last_slopes_.end(), 0.0);
  std::fill(back_since_deg_.begin(), back_since_deg_.end(), 0.0);
}

void ExtremeFinder::see(double pilot_deg, bool is_in_order, double x,
                        const PathFunction::Estimate& estimate, const Judge& judge,
                        const PathFunction& function) {
  assert(pilot_deg > last_deg_ && estimate.lengths.size() == last_.size());
  const double step_rad = (pilot_deg - last_deg_) * kRadPerDeg;
  const bool counts = is_in_order && last_deg_ >= kInactiveFrom_deg;
  double first_x = std::numeric_limits<double>::infinity();
  int first_of = -1;
  for (int d = 0; d < static_cast<int>(last_.size()); ++d) {
    const int direction = judge.direction(d);
    if (direction == 0) continue;
    if (last_deg_ == 0 && !function.is_even()) last_slopes_[d] = function.slope(d, 0);
    // The cubic's rate is a parabola, above the least of these three (its Bernstein coefficients).
    const double left = direction * last_slopes_[d], right = direction * estimate.slopes[d];
    const double inner = 3 * direction * (estimate.lengths[d] - last_[d]) / step_rad - left - right;
    const double above = std::min({left, right, inner});
    if (above >= 0 && !(counts && above < least_slope_.slope)) {
      back_since_deg_[d] = 0;
      continue;
    }
    const BetweenSamples seen =
        look_between({last_[d], last_slopes_[d]}, {estimate.lengths[d], estimate.slopes[d]},
                     step_rad, 1, direction);
    // The variable may have changed since the last sample.
    const double last_x = last_deg_ > 0 ? function.locate(last_deg_ * kRadPerDeg) : 0;
    const Subsegment subsegment{function, d, direction, last_x, x};
    if (counts) {
      note_slope(left, last_x, last_deg_);
      if (seen.least_slope < std::min(left, right)) {
        const double least_x = subsegment.least_slope_at();
        note_slope(subsegment.slope(least_x), least_x, function.pilot(least_x) / kRadPerDeg);
      }
    }
    const bool goes_on = right >= 0, from_flat = last_deg_ == 0 && function.is_even();
    const bool sets_out_back =
        from_flat &&
        sets_out_back_at_flat(direction * (estimate.lengths[d] - last_[d]), right, step_rad);
    if (goes_on && !(from_flat ? sets_out_back : seen.least_slope < 0)) {
      back_since_deg_[d] = 0;
      continue;
    }
    double from_deg = back_since_deg_[d];
    if (from_deg == 0) {
      const double high = goes_on ? subsegment.least_slope_at() : x;
      if (!sets_out_back && subsegment.slope(high) >= 0) continue;
      const double root = sets_out_back ? 0 : subsegment.root_of_slope(high);
      from_deg = function.pilot(root) / kRadPerDeg;
      if (root < first_x) {
        first_x = root;
        first_of = d;
      }
    }
    back_since_deg_[d] = goes_on ? 0 : from_deg;
    if (!is_in_order || !goes_on || seen.back < kBumpBand_widths) continue;
    if (extremes_.bump_deg && *extremes_.bump_deg <= from_deg) continue;
    extremes_.bump_deg = from_deg;
    extremes_.bump_where = d;
  }
  if (first_of >= 0 && reversal_.diagonal < 0) note_reversal(first_of, first_x, function);
  pass(pilot_deg, estimate);
}

void ExtremeFinder::pass(double pilot_deg, const PathFunction::Estimate& estimate) {
  last_deg_ = pilot_deg;
  last_ = estimate.lengths;
  last_slopes_ = estimate.slopes;
}

void ExtremeFinder::note_slope(double slope, double x, double pilot_deg) {
  if (slope < least_slope_.slope) least_slope_ = {slope, x, pilot_deg};
}

void ExtremeFinder::note_bump(int diagonal, double from_deg) {
  extremes_.bump_where = diagonal;
  extremes_.bump_deg = from_deg;
}

void ExtremeFinder::note_reversal(int diagonal, double x, const PathFunction& function) {
  assert(diagonal >= 0 && diagonal < std::ssize(last_));
  constexpr double kPart = 1e-3;  // share of a segment
  const double half_step = kPart * (function.to() - function.from());
  const double pilot_deg = function.pilot(x) / kRadPerDeg;
  reversal_ = {diagonal, x, pilot_deg,
               (function.slope(diagonal, x + half_step) - function.slope(diagonal, x - half_step)) /
                   (function.pilot(x + half_step) - function.pilot(x - half_step))};
  extremes_.reverses_deg = pilot_deg;
}

}  // namespace misalign::solver
