#include "solver/continuation/step.hpp"

#include <cassert>
#include <cmath>

#include "solver/continuation/hermite.hpp"

namespace misalign::solver {
namespace {

// Opening below which Newton's method has found a solution.
constexpr double kFound = 1e-6;

}  // namespace

// The tangent is not a number if a coordinate or pivot is not; the residual's and the corrections'
// largest entries may hide that.
bool NewtonReport::is_finite() const {
  return std::isfinite(open_by) && std::isfinite(tangent_pilot);
}

void PathStep::extrapolate(const double* at, const double* rates, int count, int newest,
                           bool from_flat, double x) {
  assert(count > 0 && count <= kStateNodes && count <= newest + 1);
  const double origin = 0;
  double values_by_age[kStateNodes], rates_by_age[kStateNodes];
  hermite_weights(at, count, from_flat ? &origin : nullptr, x, values_by_age, rates_by_age,
                  &of_flat);
  for (int k = 0; k < count; ++k) {
    const int place = (newest - k) % kStatePlaces;
    of_values[place] = values_by_age[k];
    of_rates[place] = rates_by_age[k] / rates[k];
  }
  depart = true;
}

void PathStep::go_along(int node, double length) {
  of_values[node % kStatePlaces] = 1;
  of_rates[node % kStatePlaces] = length;
  depart = true;
}

Correction::Now Correction::after(const NewtonReport& report, const Options& options,
                                  bool is_first) {
  if (count_ == 0) first_rad_ = report.correction_rad;
  corrected_rad_ += report.correction_rad;
  if (!report.is_finite()) return Now::given_up;
  const bool is_near = corrected_rad_ <= options.longest_rad;
  const bool is_closed = report.open_by <= options.closure_tolerance && count_ >= options.least;
  if (is_closed) return is_near ? Now::closed : Now::given_up;
  const bool grows = count_ > (is_first ? 2 : 1) && !(report.open_by < last_open_);
  const bool crawls =
      count_ > 0 && last_open_ < kFound && options.least_gain * report.open_by > last_open_;
  last_open_ = report.open_by;
  if (grows || crawls || count_ == options.most || !is_near) return Now::given_up;
  ++count_;
  return Now::goes_on;
}

bool is_own_curve(const NewtonReport& report, double tangent_sign, int forward_sign,
                  double least_tangent_cosine) {
  return report.orientation * tangent_sign == forward_sign &&
         std::abs(report.tangent_cosine) >= least_tangent_cosine;
}

}  // namespace misalign::solver
