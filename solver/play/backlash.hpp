// The study of backlash: how often a sheet still moves one way, each time with every joint settled
// somewhere else in its play.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/play/backlash_follower.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::solver {

/// "flat", ...: as in files.
const char* name_of(BacklashTrial::BranchEnd end);

/// What was found of one sheet.
struct Backlash {
  double backlash_mm;
  double from_deg, own_deg;           ///< the range that is asked about: own_deg is D
  std::vector<BacklashTrial> trials;  ///< in order, with this backlash
  double panel_width_mm;
  /// The largest backlash with which at least kWantedShare of the same trials move one way, scaled;
  /// undecided ones do not count. 0: not even with the least; most_mm: with the most, too.
  double largest_mm, least_mm, most_mm;
  std::uint64_t with_largest;  ///< trials that move one way with it

  std::uint64_t undecided() const;
  /// Trials that move one way from from_deg up to this angle.
  std::uint64_t one_way_to(double pilot_deg) const;

  /// Of the trials that know one, ascending: where the branch is lost, where the stretch begins and
  /// ends, and what is left over round whole vertices, in backlashes.
  std::vector<double> lost_deg() const;
  std::vector<double> one_way_from_deg() const;
  std::vector<double> one_way_to_deg() const;
  std::vector<double> left_over() const;
};

/// What this share of values in ascending order stays at or below, at least one.
double quantile(const std::vector<double>& values, double share);

}  // namespace misalign::solver
