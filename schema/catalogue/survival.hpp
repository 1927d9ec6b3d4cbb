// Estimates survival: the share of draws that deploy from each angle, counted in the fault sample,
// and extrapolated beyond its largest D.
#pragma once

#include <map>
#include <optional>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/weighted_count.hpp"

namespace misalign::schema {

/// Extrapolation of a survival curve beyond the draws seen.
struct SurvivalGuess {
  double rate;       ///< share of the draws, above 0
  double low, high;  ///< 95 % interval if the tail continues as seen, which nobody knows
};

class Survival {
 public:
  Survival(double sample_deg, int last_sample)
      : sample_deg_(sample_deg), last_sample_(last_sample) {}

  /// Adds draws with this sample as D; a sample outside the path is its end.
  void add(int deploys_from_sample, const WeightedCount& draws);

  const WeightedCount& all() const { return all_; }
  /// Returns the draws that deploy from at least this sample.
  WeightedCount from(int sample) const;
  /// Returns the deepest sample from which a draw deploys; 0 without draws.
  int deepest() const { return at_.empty() ? 0 : at_.rbegin()->first; }
  double deg(int sample) const { return sample * sample_deg_; }
  double sample_deg() const { return sample_deg_; }

  /// Returns the deepest sample from which at least this share of the draws deploys, as far as
  /// seen: none if fewer than two rows (by the effective number) are as deep.
  std::optional<int> sample_of_share(double share) const;

  /// Estimates the share of draws that deploy from at least this sample by the tail; none if fewer
  /// than eight draws make a tail, that is with fewer than 32 in all.
  ///
  /// The tail is a Pareto distribution of t = tan(pilot angle / 2), the variable in which the
  /// closure is algebraic: the share beyond t falls as a power of t. The power is Hill's estimate
  /// (Annals of Statistics 3, 1975) from the twenty deepest draws, at most a quarter of all, each
  /// weighted. A factor (1 - 1 / rows) makes it unbiased. The logarithm of the estimate has the
  /// variance (1 + (power * distance in ln t)^2) / rows. At 180 degrees, where t is infinite, half
  /// a sample less is used.
  ///
  /// Accuracy (results/survival.md, 6 x 6, interior vertices, 0.4 mm): from 1,000 sampled draws on,
  /// single estimates of the share at 160 to 175 degrees (0.9 % to 0.003 %) were 0.35 to 2.6 times
  /// the count of millions of draws; from 500, 0.3 to 8.4 times; from 250, 0.5 to 81 times, since
  /// the tail begins where the curve is still flatter. An exponential of the angle itself, from
  /// 140 to 155 degrees, is a hundred times too large at 175.
  std::optional<SurvivalGuess> guess(int sample) const;

  /// Returns the deepest sample from which at least this share of the draws deploys, as seen or
  /// else by the tail; none without a tail.
  std::optional<int> sample_to_try(double share) const;

 private:
  struct Tail {
    int first_sample;
    double share, rows, power;
  };
  std::optional<Tail> tail() const;
  double ln_t(double deg) const;
  static double guessed(const Tail& tail, double distance);

  const double sample_deg_;
  const int last_sample_;
  std::map<int, WeightedCount> at_;
  WeightedCount all_;
};

/// Reads the catalogue's fault sample, with undecided draws as far as their paths were followed.
/// UserError (bad_input) if the catalogue has no samples of its paths.
Survival read_survival(SQLite::Database& database);

}  // namespace misalign::schema
