// Defines a campaign's criterion beyond diagonals that are monotone at the samples.
#pragma once

#include <optional>
#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/verdict/between.hpp"

namespace misalign::solver {

/// A step shorter than this neither sets nor breaks a diagonal's direction (8e-11 mm on 80 mm
/// panels): converged lengths differ by less, and without a band patterns with few shifts would be
/// decided by rounding.
inline constexpr double kStepBand_widths = 1e-12;

/// Springs of stiffness k on all diagonals, relaxed at one pilot angle, store k/2 sum (L - L0)^2.
/// Its second derivative by the pilot angle is k times this sum of squares of the diagonals' slopes
/// (panel widths^2 per radian^2 for panel widths per radian).
inline double stop_stiffness(const std::vector<double>& slopes) {
  double sum = 0;
  for (const double slope : slopes) sum += slope * slope;
  return sum;
}

/// Criterion of the total energy: that of the filling falls at every sample from the threshold down
/// to flat (Saito, Tsukahara & Okabe 2016, section 5: "the total strain energy in the actuating
/// elements must be monotonically decreasing"). Diagonals need not be monotone.
struct EnergyCriterion {
  /// Springs of one rate, or plates of one cut-out, relaxed flat apart from preload or pre-stretch.
  Fill fill;
  int from_sample = 0;  ///< the threshold
  /// Least critical friction from the threshold, N mm per mm: the least ratio of
  /// E(from) - E(rho) to sum of l (|phi(from)| - |phi(rho)|) over the samples rho below, and flat.
  double least_friction_n_mm_per_mm = 0;
  /// Least moment dE / d(pilot), N mm, at the samples from kInactiveFrom_deg to the threshold.
  double least_moment_n_mm = 0;
};

struct Criterion {
  BumpRule bumps = BumpRule::ignored;
  /// Sample at which the sheet is to stop (0: none), and least stiffness of the stop (panel
  /// widths^2 per radian^2).
  int stop_sample = 0;
  double least_stop_stiffness = 0;
  /// True if verdicts have a score (score.hpp).
  bool scores = false;
  /// None: all diagonals must be monotone (the paper's simplest case).
  std::optional<EnergyCriterion> energy = {};

  bool asks_for_stop() const { return stop_sample > 0; }
  bool asks_for_moment() const { return energy && energy->least_moment_n_mm > 0; }
  /// Returns whether it needs the diagonals' slopes at samples.
  bool asks_for_slopes() const { return asks_for_stop() || asks_for_moment(); }
  /// The criterion that the energy of its filling, or else of the paper's springs, falls to flat,
  /// whatever the margins.
  Criterion without_margins() const {
    Criterion falls;
    falls.energy = EnergyCriterion{energy ? energy->fill : Fill(Springs{})};
    return falls;
  }
  /// Returns whether the sheet is to stop at this sample and the stop is too soft with these
  /// slopes.
  bool finds_soft_stop(int sample, const std::vector<double>& slopes) const {
    return asks_for_stop() && sample == stop_sample && stop_part(slopes) < 1;
  }
  /// The stop's stiffness divided by the least.
  double stop_part(const std::vector<double>& slopes) const {
    return stop_stiffness(slopes) / least_stop_stiffness;
  }
};

}  // namespace misalign::solver
