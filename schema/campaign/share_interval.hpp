// Computes confidence intervals of a counted share.
#pragma once

#include <cstdint>

namespace misalign::schema {

struct ShareInterval {
  double low, high;
  friend bool operator==(const ShareInterval&, const ShareInterval&) = default;
};

/// Returns the share of hits in all trials; 0 without any.
double share(std::uint64_t hits, std::uint64_t trials);

/// Returns the exact (Clopper-Pearson) 95 % interval of a share of `hits` in `trials`: each end
/// excludes 2.5 %. If all or none hit, there is only one end, which excludes 5 %: from 0 to 3 /
/// trials for none, the rule of three. (0, 1) without trials.
ShareInterval share_interval(std::uint64_t hits, std::uint64_t trials);

/// Returns the interval for numbers that need not be whole: effective ones, see WeightedCount.
ShareInterval share_interval_of(double hits, double trials);

/// Returns the interval if `undecided` more of the trials may have hit: the low end counts none of
/// them, the high end all.
ShareInterval share_interval(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials);

/// A share with its 95 % interval, in which undecided trials may all be hits or none.
struct ShareOfTrials {
  double share;  ///< share of the decided trials
  double low, high;
};
ShareOfTrials share_of(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials);

}  // namespace misalign::schema
