// Polynomials through values and rates of change at nodes (Hermite interpolation): weights for a
// point, and Newton's divided differences for many functions of the same nodes at once.
#pragma once

#include <vector>

namespace misalign::solver {

/// With which weights values and rates at distinct nodes make the polynomial's value at `x`. If
/// `origin` is given, the value there counts too, with a weight of its own, its rate does not.
void hermite_weights(const double* nodes, int count, const double* origin, double x,
                     double* of_values, double* of_rates, double* of_origin);

/// Several functions through the same nodes, each with its value and its rate there (order 2 n for
/// n nodes; Stoer & Bulirsch, Introduction to Numerical Analysis, 2.1.5).
class HermiteTable {
 public:
  /// At most, for one that is asked for a rate's coefficients.
  static constexpr int kMostOrder = 12;

  /// Room for so many functions and nodes. Allocates nothing afterwards.
  HermiteTable(int functions, int most_nodes);

  /// New nodes follow; what comes first decides most.
  void begin() { order_ = 0; }
  /// The next node: values and rates of all functions there.
  void add(double x, const double* values, const double* rates);
  /// The same without rates, after all others.
  void add_value(double x, const double* values);
  /// Once all nodes are there.
  void finish();

  int order() const { return order_; }
  double value(int function, double x) const;
  double rate(int function, double x) const;
  double value_and_rate(int function, double x, double& rate) const;
  double second_rate(int function, double x) const;
  /// The sizes of the last two terms of all functions at x: by how much the polynomial would change
  /// there if the last node were left out. That bounds its error as long as terms fall.
  double last_terms(int function, double x) const;
  /// The largest of any function.
  double largest_last_terms(double x) const;
  /// A function's rate on [from, to] by its Bernstein coefficients, which enclose it: order() - 1
  /// of them.
  void find_rate(int function, double from, double to, double* coefficients) const;
  /// By how much the rate of any function would change anywhere on [from, to], at most, without the
  /// last terms: so many of them.
  double largest_rate_change(double from, double to, int last_terms) const;
  /// The first so many functions at once, their values and last terms.
  void find_values(double x, int functions, double* values, double* last_terms) const;
  /// The same with rates.
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
