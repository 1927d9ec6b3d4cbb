// The study of backlash: how often a sheet still moves in one way, in trials with every joint
// settled anew in its play.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/play/backlash_follower.hpp"
#include "solver/play/quantile.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::solver {

/// Name in files: "flat", ...
const char* name_of(BacklashTrial::BranchEnd end);

/// Backlash of one sheet.
struct Backlash {
  double backlash_mm;
  double from_deg, to_deg;            ///< range of angles studied: to_deg is that of use, or D
  double own_deg;                     ///< D
  std::vector<BacklashTrial> trials;  ///< trials with this backlash, in order
  double panel_width_mm;
  /// The largest backlash with which at least kWantedShare of the same trials move one way, scaled;
  /// undecided ones do not count. 0: fewer with least_mm already; most_mm: enough with that, too.
  double largest_mm, least_mm, most_mm;
  std::uint64_t with_largest;  ///< trials that move one way with it

  std::uint64_t undecided() const;
  /// Trials that move one way from from_deg up to this angle.
  std::uint64_t one_way_to(double pilot_deg) const;

  /// Values of the trials that have one, ascending: the end of the branch, both ends of the range
  /// in one way, and the gap round whole vertices, in backlashes.
  std::vector<double> lost_deg() const;
  std::vector<double> one_way_from_deg() const;
  std::vector<double> one_way_to_deg() const;
  std::vector<double> left_over() const;
  /// Pilot angles where trials stop short of flat, above from_deg.
  std::vector<double> stops_deg() const;
};

}  // namespace misalign::solver
