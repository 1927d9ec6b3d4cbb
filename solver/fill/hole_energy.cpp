#include "solver/fill/hole_energy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Twice the energy per G t A0 by I1 and J^2, with first and second derivatives.
struct Density {
  double value = 0, by_i = 0, by_j = 0, by_ii = 0, by_ij = 0, by_jj = 0;
};

// Square of the largest stretch.
double largest_square(double i1, double j2) {
  return (i1 + std::sqrt(std::max(0.0, i1 * i1 - 4 * j2))) / 2;
}

Tension tension_at(double largest_square, double j2) {
  const double least_square = j2 / largest_square;
  if (least_square * std::sqrt(largest_square) >= 1) return Tension::both;
  return largest_square > 1 ? Tension::wrinkled : Tension::slack;
}

Density density(double i1, double j2) {
  const double q = largest_square(i1, j2);
  switch (tension_at(q, j2)) {
    case Tension::both:
      return {
          .value = i1 + 1 / j2 - 3, .by_i = 1, .by_j = -1 / (j2 * j2), .by_jj = 2 / (j2 * j2 * j2)};
    case Tension::wrinkled: {
      const double root = 2 * q - i1, cube = root * root * root;  // l1^2 - l2^2 > 0 here
      const double by_q = 1 - std::pow(q, -1.5), by_qq = 1.5 * std::pow(q, -2.5);
      const double q_i = (1 + i1 / root) / 2, q_j = -1 / root;
      return {.value = q + 2 / std::sqrt(q) - 3,
              .by_i = by_q * q_i,
              .by_j = by_q * q_j,
              .by_ii = by_qq * q_i * q_i - by_q * 2 * j2 / cube,
              .by_ij = by_qq * q_i * q_j + by_q * i1 / cube,
              .by_jj = by_qq * q_j * q_j - by_q * 2 / cube};
    }
    case Tension::slack:
      break;
  }
  return {};
}

}  // namespace

PlateLaw::PlateLaw(double shear_n_per_mm, const HoleShape& rest)
    : rest_(rest), factor_n_mm_(shear_n_per_mm * std::sqrt(rest.determinant()) / 4) {
  assert(shear_n_per_mm >= 0 && rest.determinant() > 0);
}

double PlateLaw::invariant(const HoleShape& shape) const {
  return (rest_.second_mm2 * shape.first_mm2 + rest_.first_mm2 * shape.second_mm2 -
          2 * rest_.product_mm2 * shape.product_mm2) /
         rest_.determinant();
}

HoleEnergy PlateLaw::at(const Eigen::Vector2d& lengths_mm, double product_mm2) const {
  const double a = lengths_mm.x(), b = lengths_mm.y(), det0 = rest_.determinant();
  const HoleShape shape{a * a, b * b, product_mm2};
  assert(shape.determinant() > 0);
  const Density w = density(invariant(shape), shape.determinant() / det0);
  // I1 and J^2 by the lengths; J^2 = (a^2 b^2 - product^2) / det0.
  const Eigen::Vector2d i_by{2 * a * rest_.second_mm2 / det0, 2 * b * rest_.first_mm2 / det0};
  const Eigen::Vector2d j_by{2 * a * b * b / det0, 2 * b * a * a / det0};
  Eigen::Matrix2d j_by2;
  j_by2 << 2 * b * b, 4 * a * b, 4 * a * b, 2 * a * a;
  j_by2 /= det0;
  HoleEnergy energy;
  energy.n_mm = factor_n_mm_ * w.value;
  energy.force_n = factor_n_mm_ * (w.by_i * i_by + w.by_j * j_by);
  const Eigen::Matrix2d mixed = i_by * j_by.transpose();
  energy.n_per_mm = w.by_ii * i_by * i_by.transpose() + w.by_ij * (mixed + mixed.transpose()) +
                    w.by_jj * j_by * j_by.transpose() + w.by_j * j_by2;
  energy.n_per_mm.diagonal() +=
      w.by_i * Eigen::Vector2d(2 * rest_.second_mm2 / det0, 2 * rest_.first_mm2 / det0);
  energy.n_per_mm *= factor_n_mm_;
  energy.across_n_per_mm =
      factor_n_mm_ * -2 * (w.by_i * rest_.product_mm2 + w.by_j * product_mm2) / det0;
  return energy;
}

PlateLaw::Stretches PlateLaw::stretches(const HoleShape& shape) const {
  const double j2 = shape.determinant() / rest_.determinant();
  const double q = largest_square(invariant(shape), j2);
  return {std::sqrt(q), std::sqrt(j2 / q), tension_at(q, j2)};
}

}  // namespace misalign::solver
