// The least rate of change and the first reversal that a path's function has: where they are to be
// solved, and what comes of it.
#pragma once

#include <optional>
#include <vector>

#include "solver/judging/extreme_finder.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

class FoundSlopes {
 public:
  /// As the function has them.
  void begin(const ExtremeFinder& finder);
  bool has_reversal() const { return reversal_.reversal().diagonal >= 0; }
  /// Where the reversal is to be solved next, with these slopes where it was last; nothing once it
  /// is there, or farther off than the function may be.
  std::optional<double> next_reversal_deg(const std::vector<double>& slopes);
  /// Puts both into the record's extremes, with the slopes at D, at the least rate and at the
  /// reversal as they were solved. False: they are not certain.
  bool put_into(PathRecord& record, const std::vector<double>& at_d,
                const std::vector<double>& at_least, const std::vector<double>& at_reversal) const;

 private:
  // Flat is where it turns back: nothing is to be solved.
  bool sets_out_back() const { return reversal_.reversal().pilot_deg == 0; }

  LeastSlope least_;
  ReversalSecants reversal_;
};

}  // namespace misalign::solver
