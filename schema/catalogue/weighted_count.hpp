// Shares of all draws, and how precise they are, estimated from rows that stand for several draws
// each.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>

#include "schema/campaign/share_interval.hpp"

namespace misalign::schema {

struct WeightedCount {
  std::uint64_t rows = 0;
  double draws = 0;    ///< that they stand for: the sum of their weights
  double squares = 0;  ///< the sum of the weights' squares

  /// `rows` of one weight.
  static WeightedCount of(std::uint64_t rows, double weight);
  WeightedCount& operator+=(const WeightedCount& other);
  /// How many rows of one weight would say as much: (sum w)^2 / sum w^2 (Kish, Survey Sampling,
  /// 1965, section 11.7). For draws that are independent of their weights, as here, the variance
  /// of a weighted share p is exactly p (1 - p) over this.
  double effective() const { return squares > 0 ? draws * draws / squares : 0; }
};

/// The share of the draws that `part` of `all` stands for; 0 without rows.
double share(const WeightedCount& part, const WeightedCount& all);

/// Its 95 % interval: that of share_interval() for the effective number of rows (Korn and Graubard,
/// Survey Methodology 24, 1998), and exactly that where all weights are equal.
ShareInterval share_interval(const WeightedCount& part, const WeightedCount& all);

/// So many rows of fault_sample with one weight. UserError (bad_input) if no row has that weight:
/// SQLite looks at no CHECK while it reads.
WeightedCount sampled_rows(const SQLite::Database& database, const SQLite::Column& rows,
                           const SQLite::Column& weight);

}  // namespace misalign::schema
