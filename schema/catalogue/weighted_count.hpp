// Estimates shares of all draws, and their precision, from rows that stand for several draws each.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>

#include "schema/campaign/share_interval.hpp"

namespace misalign::schema {

struct WeightedCount {
  std::uint64_t rows = 0;
  double draws = 0;    ///< sum of the weights: draws that the rows stand for
  double squares = 0;  ///< sum of the squared weights

  /// Returns the count of `rows` with one weight.
  static WeightedCount of(std::uint64_t rows, double weight);
  WeightedCount& operator+=(const WeightedCount& other);
  /// Returns the effective number of rows, (sum w)^2 / sum w^2 (Kish, Survey Sampling, 1965,
  /// section 11.7): rows of equal weight with the same precision. For draws that are independent of
  /// their weights, as here, the variance of a weighted share p is exactly p (1 - p) over this.
  double effective() const { return squares > 0 ? draws * draws / squares : 0; }
};

/// Returns the share of the draws that `part` of `all` stands for; 0 without rows.
double share(const WeightedCount& part, const WeightedCount& all);

/// Returns the 95 % interval of that share: share_interval() of the effective number of rows (Korn
/// and Graubard, Survey Methodology 24, 1998), and exactly that of the rows if all weights are
/// equal.
ShareInterval share_interval(const WeightedCount& part, const WeightedCount& all);

/// Returns the count of `rows` of fault_sample with one weight. UserError (bad_input) if the weight
/// is impossible: SQLite evaluates no CHECK while it reads.
WeightedCount sampled_rows(const SQLite::Database& database, const SQLite::Column& rows,
                           const SQLite::Column& weight);

}  // namespace misalign::schema
