#include "solver/fill/hole_energy.hpp"

#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Principal stretches from C - 1, whose small differences rounding leaves alone near the rest.
struct Principal {
  double largest_less_1, least_less_1;  // of the squares of the stretches
  Vector2d along;                       // direction of the largest
  Tension tension;
};

Principal principal_of(const Matrix2d& strain) {
  const double mean = strain.trace() / 2, half = (strain(0, 0) - strain(1, 1)) / 2;
  const double radius = std::hypot(half, strain(0, 1)), angle = std::atan2(strain(0, 1), half) / 2;
  const double largest = mean + radius, least = mean - radius;
  // least^2 >= 1 / largest, without the ones
  const double root = std::sqrt(1 + largest);
  const bool is_tense = least * root + largest / (root + 1) >= 0;
  return {largest, least, Vector2d(std::cos(angle), std::sin(angle)),
          is_tense      ? Tension::both
          : largest > 0 ? Tension::wrinkled
                        : Tension::slack};
}

// Twice the energy per G t A0 with its derivative by C, and the second one between two changes.
class Density {
 public:
  explicit Density(const Matrix2d& strain)
      : principal_(principal_of(strain)), inverse_((Matrix2d::Identity() + strain).inverse()) {
    const double q = 1 + principal_.largest_less_1;
    if (principal_.tension == Tension::both) {
      const double growth = strain.trace() + strain.determinant();  // J^2 - 1
      squared_ = 1 + growth;
      value = (strain.trace() * growth - strain.determinant()) / squared_;
      by_c = Matrix2d::Identity() - inverse_ / squared_;
    } else if (principal_.tension == Tension::wrinkled) {
      const double stretch = std::sqrt(q), longer = principal_.largest_less_1 / (stretch + 1);
      value = longer * longer * (stretch + 2) / stretch;
      by_q_ = -std::expm1(-1.5 * std::log1p(principal_.largest_less_1));
      by_qq_ = 1.5 * std::pow(q, -2.5);
      by_c = by_q_ * principal_.along * principal_.along.transpose();
    }
  }

  double second(const Matrix2d& first, const Matrix2d& next) const {
    if (principal_.tension == Tension::both) {
      const Matrix2d a = inverse_ * first, b = inverse_ * next;
      return ((a * b).trace() + a.trace() * b.trace()) / squared_;
    }
    if (principal_.tension == Tension::slack) return 0;
    const Vector2d n = principal_.along, m(-n.y(), n.x());
    const double apart = principal_.largest_less_1 - principal_.least_less_1;
    return by_qq_ * n.dot(first * n) * n.dot(next * n) +
           by_q_ * 2 / apart * n.dot(first * m) * n.dot(next * m);
  }

  double value = 0;
  Matrix2d by_c = Matrix2d::Zero();

 private:
  Principal principal_;
  Matrix2d inverse_;
  double squared_ = 0, by_q_ = 0, by_qq_ = 0;
};

}  // namespace

PlateLaw::PlateLaw(double shear_n_per_mm, const HoleShape& rest)
    : rest_(rest), factor_n_mm_(shear_n_per_mm * std::sqrt(rest.determinant()) / 4) {
  assert(shear_n_per_mm >= 0 && rest.determinant() > 0);
  const double first_mm = std::sqrt(rest.first_mm2);
  const double across_mm = std::sqrt(rest.determinant()) / first_mm;
  to_diagonals_ << 1 / first_mm, -rest.product_mm2 / (rest.first_mm2 * across_mm), 0, 1 / across_mm;
}

Matrix2d PlateLaw::strain(const HoleShape& shape) const {
  const double product_mm2 = shape.product_mm2 - rest_.product_mm2;
  Matrix2d longer_mm2;
  longer_mm2 << shape.first_mm2 - rest_.first_mm2, product_mm2, product_mm2,
      shape.second_mm2 - rest_.second_mm2;
  return to_diagonals_.transpose() * longer_mm2 * to_diagonals_;
}

HoleEnergy PlateLaw::at(const Vector2d& lengths_mm, double product_mm2) const {
  const HoleShape shape{lengths_mm.x() * lengths_mm.x(), lengths_mm.y() * lengths_mm.y(),
                        product_mm2};
  assert(shape.determinant() > 0);
  const Density w(strain(shape));
  const Matrix2d by_gram = factor_n_mm_ * to_diagonals_ * w.by_c * to_diagonals_.transpose();
  HoleEnergy energy;
  energy.n_mm = factor_n_mm_ * w.value;
  energy.force_n = 2 * lengths_mm.cwiseProduct(by_gram.diagonal());
  energy.across_n_per_mm = 2 * by_gram(0, 1);
  std::array<Matrix2d, 2> changes;  // of C, by the lengths
  for (int k = 0; k < 2; ++k) {
    const Vector2d row = to_diagonals_.row(k);
    changes[static_cast<std::size_t>(k)] = 2 * lengths_mm(k) * row * row.transpose();
  }
  for (int k = 0; k < 2; ++k) {
    for (int l = 0; l < 2; ++l) {
      energy.n_per_mm(k, l) = factor_n_mm_ * w.second(changes[static_cast<std::size_t>(k)],
                                                      changes[static_cast<std::size_t>(l)]);
    }
    energy.n_per_mm(k, k) += 2 * by_gram(k, k);
  }
  return energy;
}

PlateLaw::Stretches PlateLaw::stretches(const HoleShape& shape) const {
  const Principal principal = principal_of(strain(shape));
  return {std::sqrt(1 + principal.largest_less_1), std::sqrt(1 + principal.least_less_1),
          principal.tension};
}

}  // namespace misalign::solver
