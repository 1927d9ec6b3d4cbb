#include "solver/continuation/hermite.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {

void hermite_weights(const double* nodes, int count, const double* origin, double x,
                     double* of_values, double* of_rates, double* of_origin) {
  assert(count >= 0 && (!origin || of_origin));
  for (int k = 0; k < count; ++k) {
    double basis = 1, basis_rate = 0;
    for (int i = 0; i < count; ++i) {
      if (i == k) continue;
      const double share = (x - nodes[i]) / (nodes[k] - nodes[i]);
      basis *= share * share;
      basis_rate += 2 / (nodes[k] - nodes[i]);
    }
    if (origin) {
      basis *= (x - *origin) / (nodes[k] - *origin);
      basis_rate += 1 / (nodes[k] - *origin);
    }
    of_values[k] = basis * (1 - (x - nodes[k]) * basis_rate);
    of_rates[k] = basis * (x - nodes[k]);
  }
  if (!origin) return;
  double basis = 1;
  for (int i = 0; i < count; ++i) {
    const double share = (x - nodes[i]) / (*origin - nodes[i]);
    basis *= share * share;
  }
  *of_origin = basis;
}

HermiteTable::HermiteTable(int functions, int most_nodes)
    : functions_(functions),
      nodes_(static_cast<std::size_t>(2 * most_nodes)),
      terms_(nodes_.size() * static_cast<std::size_t>(functions)),
      rates_(terms_.size()) {}

void HermiteTable::add(double x, const double* values, const double* rates) {
  assert(static_cast<std::size_t>(order_) + 2 <= nodes_.size());
  for (int twice = 0; twice < 2; ++twice, ++order_) {
    nodes_[order_] = x;
    std::copy_n(values, functions_, row(order_));
    std::copy_n(rates, functions_, rates_.data() + order_ * functions_);
  }
}

void HermiteTable::add_value(double x, const double* values) {
  assert(static_cast<std::size_t>(order_) < nodes_.size());
  nodes_[order_] = x;
  std::copy_n(values, functions_, row(order_));
  ++order_;
}

void HermiteTable::finish() {
  for (int order = 1; order < order_; ++order) {
    for (int i = order_ - 1; i >= order; --i) {
      double* const differences = row(i);
      if (order == 1 && i % 2 == 1) {
        std::copy_n(rates_.data() + i * functions_, functions_, differences);
        continue;
      }
      const double* const before = row(i - 1);
      const double per_gap = 1 / (nodes_[i] - nodes_[i - order]);
      for (int f = 0; f < functions_; ++f) differences[f] = (differences[f] - before[f]) * per_gap;
    }
  }
}

double HermiteTable::value(int function, double x) const {
  assert(function >= 0 && function < functions_);
  double sum = 0;
  for (int k = order_ - 1; k >= 0; --k) sum = sum * (x - nodes_[k]) + row(k)[function];
  return sum;
}

double HermiteTable::value_and_rate(int function, double x, double& rate) const {
  double sum = 0;
  rate = 0;
  for (int k = order_ - 1; k >= 0; --k) {
    rate = rate * (x - nodes_[k]) + sum;
    sum = sum * (x - nodes_[k]) + row(k)[function];
  }
  return sum;
}

double HermiteTable::rate(int function, double x) const {
  double rate;
  value_and_rate(function, x, rate);
  return rate;
}

double HermiteTable::second_rate(int function, double x) const {
  double sum = 0, rate = 0, half = 0;
  for (int k = order_ - 1; k >= 0; --k) {
    half = half * (x - nodes_[k]) + rate;
    rate = rate * (x - nodes_[k]) + sum;
    sum = sum * (x - nodes_[k]) + row(k)[function];
  }
  return 2 * half;
}

void HermiteTable::find_rate(int function, double from, double to, double* coefficients) const {
  assert(order_ <= kMostOrder);
  assert(order_ >= 2);
  const double width = to - from;
  double powers[kMostOrder] = {
      row(order_ - 1)[function]};  // coefficients of powers of (x - from) / width
  for (int k = order_ - 2, degree = 0; k >= 0; --k) {
    const double at = from - nodes_[k];
    ++degree;
    for (int i = degree; i > 0; --i) powers[i] = powers[i] * at + powers[i - 1] * width;
    powers[0] = powers[0] * at + row(k)[function];
  }
  const int degree = order_ - 2;
  for (int i = 0; i <= degree; ++i) coefficients[i] = (i + 1) * powers[i + 1] / width;
  // Converts powers to Bernstein polynomials: running sums of the coefficients over binomials.
  double binomial = 1;
  for (int i = 0; i <= degree; ++i) {
    coefficients[i] /= binomial;
    binomial *= static_cast<double>(degree - i) / (i + 1);
  }
  for (int j = 1; j <= degree; ++j) {
    for (int i = degree; i >= j; --i) coefficients[i] += coefficients[i - 1];
  }
}

double HermiteTable::largest_rate_change(double from, double to, int last_terms) const {
  // Bounds the derivative of the product of distances to the first nodes, each by its largest
  // value.
  assert(order_ <= kMostOrder && last_terms <= order_);
  double product = 1, rate = 0, most = 0, change[kMostOrder] = {};
  for (int k = 0; k < order_; ++k) {
    change[k] = rate;
    const double far = std::max(std::abs(from - nodes_[k]), std::abs(to - nodes_[k]));
    rate = rate * far + product;
    product *= far;
  }
  for (int f = 0; f < functions_; ++f) {
    double sum = 0;
    for (int k = order_ - last_terms; k < order_; ++k) sum += std::abs(row(k)[f]) * change[k];
    most = std::max(most, sum);
  }
  return most;
}

void HermiteTable::last_products(double x, double& before, double& last) const {
  before = 1;
  for (int k = 0; k < order_ - 2; ++k) before *= x - nodes_[k];
  last = std::abs(before * (x - nodes_[order_ - 2]));
  before = std::abs(before);
}

double HermiteTable::largest_last_terms(double x) const {
  double before, last, most = 0;
  last_products(x, before, last);
  const double *const term = row(order_ - 2), *const last_term = row(order_ - 1);
  for (int f = 0; f < functions_; ++f) {
    most = std::max(most, std::abs(term[f]) * before + std::abs(last_term[f]) * last);
  }
  return most;
}

double HermiteTable::last_terms(int function, double x) const {
  double before, last;
  last_products(x, before, last);
  return std::abs(row(order_ - 2)[function]) * before + std::abs(row(order_ - 1)[function]) * last;
}

void HermiteTable::look(double x, int functions, double* values, double* rates,
                        double* last_terms) const {
  std::fill_n(values, functions, 0.0);
  std::fill_n(rates, functions, 0.0);
  for (int k = order_ - 1; k >= 0; --k) {
    const double distance = x - nodes_[k];
    const double* const term = row(k);
    for (int f = 0; f < functions; ++f) {
      rates[f] = rates[f] * distance + values[f];
      values[f] = values[f] * distance + term[f];
    }
  }
  find_last_terms(x, functions, last_terms);
}

void HermiteTable::find_values(double x, int functions, double* values, double* last_terms) const {
  std::fill_n(values, functions, 0.0);
  for (int k = order_ - 1; k >= 0; --k) {
    const double distance = x - nodes_[k];
    const double* const term = row(k);
    for (int f = 0; f < functions; ++f) values[f] = values[f] * distance + term[f];
  }
  find_last_terms(x, functions, last_terms);
}

void HermiteTable::find_last_terms(double x, int functions, double* last_terms) const {
  double before, last;
  last_products(x, before, last);
  const double *const term = row(order_ - 2), *const last_term = row(order_ - 1);
  for (int f = 0; f < functions; ++f) {
    last_terms[f] = std::abs(term[f]) * before + std::abs(last_term[f]) * last;
  }
}

}  // namespace misalign::solver
