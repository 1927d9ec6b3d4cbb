// Hermite interpolation against closed forms: polynomials of every order that it must reproduce,
// and a function whose error is known.
#include "solver/continuation/hermite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace misalign::solver {
namespace {

// x^power, its rate and its second rate.
double power(double x, int power) { return std::pow(x, power); }
double power_rate(double x, int n) { return n == 0 ? 0 : n * std::pow(x, n - 1); }
double power_second(double x, int n) { return n < 2 ? 0 : n * (n - 1) * std::pow(x, n - 2); }

// Unequal, in no order: the newest first, then one between the others.
const std::vector<double> kNodes = {1.7, 1.1, 1.5, 0.4, 0.1};

HermiteTable table_of_powers(int functions, std::size_t nodes) {
  HermiteTable table(functions, 5);
  table.begin();
  for (std::size_t k = 0; k < nodes; ++k) {
    std::vector<double> values, rates;
    for (int n = 0; n < functions; ++n) {
      values.push_back(power(kNodes[k], n));
      rates.push_back(power_rate(kNodes[k], n));
    }
    table.add(kNodes[k], values.data(), rates.data());
  }
  table.finish();
  return table;
}

TEST(Hermite, ReproducesPolynomialsUpToItsOrder) {
  for (std::size_t nodes = 1; nodes <= kNodes.size(); ++nodes) {
    const int functions = 2 * static_cast<int>(nodes);
    const HermiteTable table = table_of_powers(functions, nodes);
    EXPECT_EQ(table.order(), functions);
    std::vector<double> values(functions), rates(functions), last(functions);
    for (const double x : {0.0, 0.25, 1.1, 1.6, 2.0}) {
      table.look(x, functions, values.data(), rates.data(), last.data());
      for (int n = 0; n < functions; ++n) {
        const double room = 1e-12 * std::pow(2.0, n);  // roundings, of the largest power there
        EXPECT_NEAR(table.value(n, x), power(x, n), room) << n;
        EXPECT_NEAR(table.rate(n, x), power_rate(x, n), 100 * room) << n;
        EXPECT_NEAR(table.second_rate(n, x), power_second(x, n), 1000 * room) << n;
        EXPECT_EQ(values[n], table.value(n, x));
        EXPECT_EQ(rates[n], table.rate(n, x));
        EXPECT_EQ(last[n], table.last_terms(n, x));
        // Nothing is lost without the last node where the others suffice.
        if (n < functions - 2) {
          EXPECT_NEAR(last[n], 0, 100 * room) << n;
        }
      }
    }
  }
}

TEST(Hermite, TheLastTermsAreWhatTheLastNodeAdds) {
  const auto table = [](std::size_t nodes) {
    HermiteTable made(1, 5);
    made.begin();
    for (std::size_t k = 0; k < nodes; ++k) {
      const double value = std::sin(kNodes[k]), rate = std::cos(kNodes[k]);
      made.add(kNodes[k], &value, &rate);
    }
    made.finish();
    return made;
  };
  const HermiteTable all = table(5), fewer = table(4);
  for (const double x : {0.2, 1.0, 1.3, 1.6}) {
    const double added = std::abs(all.value(0, x) - fewer.value(0, x));
    EXPECT_LE(added, all.last_terms(0, x) * (1 + 1e-5));
    EXPECT_GE(added, 0.01 * all.last_terms(0, x));
    // Error of four nodes: f^(8) / 8! times the product of the squared distances.
    double product = 1;
    for (std::size_t k = 0; k < 4; ++k) product *= (x - kNodes[k]) * (x - kNodes[k]);
    EXPECT_LE(std::abs(fewer.value(0, x) - std::sin(x)), product / 40320 + 1e-15);
    EXPECT_LT(std::abs(all.value(0, x) - std::sin(x)), all.last_terms(0, x) + 1e-15);
  }
}

// With an origin whose value alone is known: one order more.
TEST(Hermite, WeightsMakeTheSamePolynomial) {
  const double origin = 0;
  for (int nodes = 1; nodes <= 4; ++nodes) {
    for (const bool with_origin : {false, true}) {
      double of_values[4], of_rates[4], of_origin = 0;
      const int order = 2 * nodes + (with_origin ? 1 : 0);
      for (const double x : {0.3, 1.2, 1.9}) {
        hermite_weights(kNodes.data(), nodes, with_origin ? &origin : nullptr, x, of_values,
                        of_rates, &of_origin);
        for (int n = 0; n < order; ++n) {
          double sum = with_origin ? of_origin * power(0, n) : 0;
          for (int k = 0; k < nodes; ++k) {
            sum += of_values[k] * power(kNodes[k], n) + of_rates[k] * power_rate(kNodes[k], n);
          }
          EXPECT_NEAR(sum, power(x, n), 1e-9 * std::pow(2.0, n)) << nodes << " nodes, power " << n;
        }
      }
    }
  }
}

// Bernstein coefficients of a rate: its values at both ends, its mean over the stretch, and between
// the least and the largest of them at every point.
TEST(Hermite, CoefficientsEncloseARate) {
  for (std::size_t nodes = 2; nodes <= kNodes.size(); ++nodes) {
    const int functions = 2 * static_cast<int>(nodes);
    const HermiteTable table = table_of_powers(functions, nodes);
    for (int n = 0; n < functions; ++n) {
      double rate[HermiteTable::kMostOrder], sum = 0;
      table.find_rate(n, 0.3, 1.9, rate);
      const int count = table.order() - 1;
      const double room = 1e-10 * std::pow(2.0, n);
      EXPECT_NEAR(rate[0], power_rate(0.3, n), room);
      EXPECT_NEAR(rate[count - 1], power_rate(1.9, n), room);
      for (int k = 0; k < count; ++k) sum += rate[k];
      EXPECT_NEAR(sum / count * 1.6, power(1.9, n) - power(0.3, n), room);
      const auto [least, most] = std::minmax_element(rate, rate + count);
      for (double x = 0.3; x < 1.9; x += 0.01) {
        EXPECT_GT(power_rate(x, n), *least - room);
        EXPECT_LT(power_rate(x, n), *most + room);
      }
    }
  }
}

// What rates change by without the last node, or the last value, against tables without it.
TEST(Hermite, BoundsWhatRatesLoseWithoutTheLast) {
  constexpr int kFunctions = 12;  // of higher powers than the tables have orders
  const HermiteTable all = table_of_powers(kFunctions, 4), fewer = table_of_powers(kFunctions, 3);
  HermiteTable with_value(kFunctions, 5);
  with_value.begin();
  std::vector<double> values(kFunctions), rates(kFunctions);
  for (std::size_t k = 0; k < 3; ++k) {
    for (int n = 0; n < kFunctions; ++n) {
      values[n] = power(kNodes[k], n);
      rates[n] = power_rate(kNodes[k], n);
    }
    with_value.add(kNodes[k], values.data(), rates.data());
  }
  for (int n = 0; n < kFunctions; ++n) values[n] = power(kNodes[3], n);
  with_value.add_value(kNodes[3], values.data());
  with_value.finish();
  EXPECT_EQ(with_value.order(), 7);
  for (int n = 0; n < kFunctions; ++n) {
    EXPECT_NEAR(with_value.value(n, kNodes[3]), values[n], 1e-10);
  }
  double closest = 0, closest_with_value = 0;
  for (double x = 1.1; x < 1.7; x += 0.01) {
    double change = 0, change_with_value = 0;
    for (int n = 0; n < kFunctions; ++n) {
      change = std::max(change, std::abs(all.rate(n, x) - fewer.rate(n, x)));
      change_with_value =
          std::max(change_with_value, std::abs(with_value.rate(n, x) - fewer.rate(n, x)));
    }
    EXPECT_LE(change, all.largest_rate_change(x, x, 2) + 1e-9);
    EXPECT_LE(change, all.largest_rate_change(1.1, 1.7, 2) + 1e-9);
    EXPECT_LE(change_with_value, with_value.largest_rate_change(x, x, 1) + 1e-9);
    closest = std::max(closest, change / all.largest_rate_change(x, x, 2));
    closest_with_value =
        std::max(closest_with_value, change_with_value / with_value.largest_rate_change(x, x, 1));
  }
  EXPECT_GT(closest, 0.1);
  EXPECT_GT(closest_with_value, 0.1);
}

}  // namespace
}  // namespace misalign::solver
