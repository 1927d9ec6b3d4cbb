#include "solver/bending/energy_curve.hpp"

#include <cassert>
#include <cmath>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd EnergyCurve::Series::points(double low, double high, int count) {
  VectorXd points(count);
  for (int k = 0; k < count; ++k) {
    points(k) = (low + high) / 2 - (high - low) / 2 * std::cos(kPi * k / (count - 1));
  }
  return points;
}

EnergyCurve::Series::Series(double low, double high, const VectorXd& values)
    : low_(low), high_(high), coefficients_(values.size()) {
  const Index last = values.size() - 1;
  assert(low < high && last >= 1);
  const auto half = [&](Index k) { return k == 0 || k == last ? 0.5 : 1.0; };
  for (Index j = 0; j <= last; ++j) {
    double sum = 0;
    for (Index k = 0; k <= last; ++k) {
      // The points ascend, as -cos does.
      const auto turned = static_cast<double>(j * (last - k)) / static_cast<double>(last);
      sum += half(k) * values(k) * std::cos(kPi * turned);
    }
    coefficients_(j) = 2 * half(j) * sum / static_cast<double>(last);
  }
}

// T_j and their derivatives by recurrence.
EnergyCurve::Series::Value EnergyCurve::Series::at(double place) const {
  const double scale = 2 / (high_ - low_), s = (place - (low_ + high_) / 2) * scale;
  double t0 = 1, t1 = s, d0 = 0, d1 = 1;
  Value sum{0, 0};
  for (Index j = 0; j < coefficients_.size(); ++j) {
    sum.value += coefficients_(j) * t0;
    sum.slope += coefficients_(j) * d0 * scale;
    const double t2 = 2 * s * t1 - t0, d2 = 2 * t1 + 2 * s * d1 - d0;
    t0 = t1, t1 = t2, d0 = d1, d1 = d2;
  }
  return sum;
}

EnergyCurve::EnergyCurve(double least_deg, double most_deg, const VectorXd& above_flat_n_mm,
                         const VectorXd& reference_n_mm, const VectorXd& turned_mm)
    : least_deg_(least_deg), most_deg_(most_deg) {
  assert(least_deg > 0 && least_deg < most_deg);
  assert(turned_mm.minCoeff() > 0 && reference_n_mm.size() == turned_mm.size());
  const double low = std::log(least_deg), high = std::log(most_deg);
  share_ = {low, high, above_flat_n_mm.cwiseQuotient(reference_n_mm)};
  log_reference_ = {low, high, reference_n_mm.array().log()};
  log_turned_ = {low, high, turned_mm.array().log()};
}

VectorXd EnergyCurve::angles_deg(double least_deg, double most_deg, int count) {
  return Series::points(std::log(least_deg), std::log(most_deg), count).array().exp();
}

EnergyCurve::At EnergyCurve::at(double pilot_deg) const {
  assert(pilot_deg > 0);
  const double place = std::log(pilot_deg);
  const auto share = share_.at(place), reference = log_reference_.at(place),
             turned = log_turned_.at(place);
  const double scale = std::exp(reference.value), turned_mm = std::exp(turned.value);
  return {share.value * scale, turned_mm,
          (share.slope + share.value * reference.slope) * scale / (turned_mm * turned.slope)};
}

}  // namespace misalign::solver
