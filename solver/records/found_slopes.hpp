// Solves the least rate of change and the first reversal of a path's function.
#pragma once

#include <optional>
#include <vector>

#include "solver/judging/extreme_finder.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

class FoundSlopes {
 public:
  /// Takes both from the function.
  void begin(const ExtremeFinder& finder);
  bool has_reversal() const { return reversal_.reversal().diagonal >= 0; }
  /// Angle at which the reversal is solved next, given the slopes at the last; none once it is
  /// reached, or is farther off than the function's error.
  std::optional<double> next_reversal_deg(const std::vector<double>& slopes);
  /// Puts both into the record's extremes, from the solved slopes at D, at the least rate and at
  /// the reversal. Returns false if they are not certain.
  bool put_into(PathRecord& record, const std::vector<double>& at_d,
                const std::vector<double>& at_least, const std::vector<double>& at_reversal) const;

 private:
  // True if it reverses at flat, so that nothing is solved.
  bool sets_out_back() const { return reversal_.reversal().pilot_deg == 0; }

  LeastSlope least_;
  ReversalSecants reversal_;
};

}  // namespace misalign::solver
