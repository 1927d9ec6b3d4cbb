// Survival: how many draws deploy from each angle or beyond, counted in the fault sample, and
// guessed beyond the largest D in it.
#pragma once

#include <map>
#include <optional>

#include "schema/catalogue/database.hpp"
#include "schema/catalogue/weighted_count.hpp"

namespace misalign::schema {

/// What the tail of a survival curve says where no draw was seen.
struct SurvivalGuess {
  double rate;       ///< share of the draws, above 0
  double low, high;  ///< 95 %, if the tail goes on as it was seen: that it does nobody knows
};

class Survival {
 public:
  Survival(double sample_deg, int last_sample)
      : sample_deg_(sample_deg), last_sample_(last_sample) {}

  /// Draws that deploy from this sample and no deeper; a sample outside the path is its end.
  void add(int deploys_from_sample, const WeightedCount& draws);

  const WeightedCount& all() const { return all_; }
  /// Those that deploy from at least this sample.
  WeightedCount from(int sample) const;
  /// Deepest sample that any deploys from; 0 without draws.
  int deepest() const { return at_.empty() ? 0 : at_.rbegin()->first; }
  double deg(int sample) const { return sample * sample_deg_; }
  double sample_deg() const { return sample_deg_; }

  /// The deepest sample that at least this share of the draws deploys from, as far as it was seen:
  /// empty where fewer than two rows (by the effective number) would be as deep.
  std::optional<int> sample_of_share(double share) const;

  /// The share of draws that deploys from this sample or deeper, guessed from the tail; empty where
  /// fewer than eight draws make one, that is with fewer than 32 in all.
  ///
  /// The tail is taken for Pareto's in t = tan(pilot angle / 2), the variable in which the closure
  /// is algebraic: the share beyond t falls as a power of it. The power is Hill's estimate (Annals
  /// of Statistics 3, 1975) from the twenty deepest draws, at most a quarter of all, each weighed,
  /// times (1 - 1 / rows), which makes it unbiased;
  /// the logarithm of the guess has the variance (1 + (power * distance in ln t)^2) / rows. At 180
  /// degrees, where t has no end, half a sample less is meant.
  ///
  /// How far off (results/survival.md, 6 x 6, interior vertices, 0.4 mm): from 1,000 sampled draws
  /// on, single guesses of the share at 160 to 175 degrees (0.9 % to 0.003 %) were 0.35 to 2.6
  /// times what millions of draws counted; from 500, 0.3 to 8.4 times; from 250, 0.5 to 81 times,
  /// for there the tail begins where the curve is still flatter. An exponential of the angle
  /// itself, from 140 to 155 degrees, guesses a hundred times too many at 175.
  std::optional<SurvivalGuess> guess(int sample) const;

  /// The deepest sample from which, by what was seen or else by the tail, at least this share of
  /// the draws deploys; empty where there is no tail.
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

/// Of all rows of the catalogue's fault sample, undecided draws as far as their paths were
/// followed. UserError (bad_input) if the catalogue does not say where its paths are sampled.
Survival read_survival(SQLite::Database& database);

}  // namespace misalign::schema
