#include "solver/sheet/smooth_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
constexpr int kPoints = SmoothTable::kPoints;
using Square = Eigen::Matrix<double, kPoints, kPoints>;

// Row k: the coefficients of the polynomial that is 1 at first + k and 0 at the other seven places
// first, first + 1, ... (Lagrange's, multiplied out).
Square basis_from(double first) {
  Square basis = Square::Zero();
  for (int k = 0; k < kPoints; ++k) {
    basis(k, 0) = 1;
    for (int other = 0; other < kPoints; ++other) {
      if (other == k) continue;
      const double place = first + other;
      for (int power = kPoints - 1; power > 0; --power) {
        basis(k, power) = (basis(k, power - 1) - place * basis(k, power)) / (k - other);
      }
      basis(k, 0) *= -place / (k - other);
    }
  }
  return basis;
}

}  // namespace

SmoothTable::SmoothTable(const Eigen::MatrixXd& values, std::vector<Parity> parities, double step)
    : step_(step), parities_(std::move(parities)), mirrored_(values.rows()) {
  const Index places = values.cols();
  assert(places >= kPoints && values.rows() == functions());
  for (Index row = 0; row < values.rows(); ++row) {
    mirrored_(row) = parities_[static_cast<std::size_t>(row)] == Parity::odd ? -1 : 1;
  }
  Eigen::Matrix<double, Eigen::Dynamic, kPoints> known(values.rows(), kPoints);
  for (Index segment = 0; segment <= places; ++segment) {
    // Place k is k + 1/2 steps from flat; place -k - 1 is as far on the other side.
    const Index first = std::min(segment - kPoints / 2, places - kPoints);
    for (Index k = 0; k < kPoints; ++k) {
      const Index place = first + k;
      if (place >= 0) {
        known.col(k) = values.col(place);
      } else {
        known.col(k) = mirrored_.cwiseProduct(values.col(-place - 1));
      }
    }
    segments_.emplace_back(known * basis_from(static_cast<double>(first - segment) + 0.5));
  }
}

std::pair<const SmoothTable::Segment&, double> SmoothTable::at(double x) const {
  assert(step_ > 0);
  const double steps = std::abs(x) / step_;
  const auto segment = static_cast<std::size_t>(
      std::clamp(std::floor(steps + 0.5), 0.0, static_cast<double>(places())));
  return {segments_[segment], steps - static_cast<double>(segment)};
}

void SmoothTable::find(double x, Index first, Index count, Eigen::VectorXd& values,
                       Eigen::VectorXd& slopes) const {
  const auto [segment, u] = at(x);
  assert(first >= 0 && count >= 0 && first + count <= functions());
  const auto rows = segment.middleRows(first, count);
  values = rows.col(kPoints - 1);
  slopes.setZero(count);
  for (int power = kPoints - 2; power >= 0; --power) {
    slopes = slopes * u + values;
    values = values * u + rows.col(power);
  }
  slopes /= step_;
  if (x >= 0) return;
  const auto mirrored = mirrored_.segment(first, count);
  values.array() *= mirrored.array();
  slopes.array() *= -mirrored.array();
}

double SmoothTable::value(double x, Index function) const {
  const auto [segment, u] = at(x);
  assert(function >= 0 && function < functions());
  double value = 0;
  for (int power = kPoints - 1; power >= 0; --power) value = value * u + segment(function, power);
  return x < 0 ? value * mirrored_(function) : value;
}

}  // namespace misalign::solver
