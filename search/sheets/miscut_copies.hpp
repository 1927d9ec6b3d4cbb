// Counts the verdicts on miscut copies of a sheet.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/verdict/verdict.hpp"

namespace misalign::search {

struct MiscutCopies {
  std::uint64_t trials = 0;
  std::uint64_t undecided = 0;           ///< numerical failures: neither yes nor no
  std::vector<std::uint64_t> of_sample;  ///< the decided ones, counted by their D

  void add(const solver::Verdict& verdict);
  void add(const MiscutCopies& others);
  std::uint64_t decided() const { return trials - undecided; }
  /// The decided ones that deploy from this sample, or from a later one.
  std::uint64_t from(int sample) const;
  /// The D that this share of the decided ones stays at or below, at least one: 0.5 is the median.
  int quantile(double share) const;
  /// Mean of D over the decided ones.
  double mean_sample() const;
};

/// A share with its 95 % interval, in which the undecided ones may all be hits or none.
struct ShareOfTrials {
  double share;  ///< of the decided ones
  double low, high;
};
ShareOfTrials share_of(std::uint64_t hits, std::uint64_t undecided, std::uint64_t trials);
inline ShareOfTrials share_of(std::uint64_t hits, const MiscutCopies& copies) {
  return share_of(hits, copies.undecided, copies.trials);
}

}  // namespace misalign::search
