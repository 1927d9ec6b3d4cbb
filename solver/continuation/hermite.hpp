// Interpolates values and rates of change at nodes by polynomials (Hermite): weights for a point,
// and Newton's divided differences for many functions of the same nodes at once.
#pragma once

#include <vector>

namespace misalign::solver {

/// Weights of values and rates at distinct nodes in the polynomial's value at `x`. If `origin` is
/// given, the value there has a weight too, its rate none.
void hermite_weights(const double* nodes, int count, const double* origin, double x,
                     double* of_values, double* of_rates, double* of_origin);

/// Several functions through the same nodes, each with its value and its rate there (order 2 n for
/// n nodes; Stoer & Bulirsch, Introduction to Numerical Analysis, 2.1.5).
class HermiteTable {
 public:
  /// Largest order of a table for find_rate().
  static constexpr int kMostOrder = 12;

  /// Reserves room for `functions` functions and `most_nodes` nodes; allocates nothing afterwards.
  HermiteTable(int functions, int most_nodes);

  /// Empties the table for new nodes; the first ones have the most influence.
  void begin() { order_ = 0; }
  /// Adds a node with values and rates of all functions.
  void add(double x, const double* values, const double* rates);
  /// Adds a node without rates, after all others.
  void add_value(double x, const double* values);
  /// Computes the differences once all nodes are added.
  void finish();

  int order() const { return order_; }
  double value(int function, double x) const;
  double rate(int function, double x) const;
  double value_and_rate(int function, double x, double& rate) const;
  double second_rate(int function, double x) const;
  /// Size of a function's last two terms at x, the change of the polynomial without its last node.
  /// It bounds the error as long as terms decrease.
  double last_terms(int function, double x) const;
  /// The largest over all functions.
  double largest_last_terms(double x) const;
  /// A function's rate on [from, to] by its Bernstein coefficients, which enclose it: order() - 1
  /// of them.
  void find_rate(int function, double from, double to, double* coefficients) const;
  /// Upper bound of the change of any function's rate on [from, to] without the last `last_terms`
  /// terms.
  double largest_rate_change(double from, double to, int last_terms) const;
  /// Values and last terms of the first `functions` functions at once.
  void find_values(double x, int functions, double* values, double* last_terms) const;
  /// Values, rates and last terms of these functions.
  void look(double x, int functions, double* values, double* rates, double* last_terms) const;

 private:
  const double* row(int k) const { return terms_.data() + k * functions_; }
  double* row(int k) { return terms_.data() + k * functions_; }
  void last_products(double x, double& before, double& last) const;
  void find_last_terms(double x, int functions, double* last_terms) const;

  const int functions_;
  int order_ = 0;
  std::vector<double> nodes_;          // each twice
  std::vector<double> terms_, rates_;  // per entry of nodes_ and function; divided differences
};

}  // namespace misalign::solver
