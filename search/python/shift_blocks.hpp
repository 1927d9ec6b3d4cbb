// Shifts of many sheets as NumPy has them, [N, V, 2] in mm, taken block by block as lanes want
// them.
#pragma once

#include <pybind11/numpy.h>

#include "search/draws/draw_evaluator.hpp"
#include "search/python/pattern_source.hpp"

namespace misalign::search::python {

class ShiftBlocks {
 public:
  /// With the GIL. UserError (bad_request) for what is no such array. Numbers of other kinds, or
  /// elsewhere in memory, are made doubles block by block.
  ShiftBlocks(const pybind11::object& shifts_mm, const PatternSource& source);

  std::uint64_t sheets() const { return sheets_; }
  /// The sheets from `first` on; with the GIL. Valid until the next call.
  const double* rows(std::uint64_t first, std::uint64_t count);

  /// Every shift is none, or this far either way; 0: others. By the first sheets alone.
  double ternary_mm();

  /// The shifts of these vertices into `block`, numbered from `first` on. UserError (bad_request)
  /// about the first sheet that is none: not finite, or with a facet that is not convex. Without
  /// the GIL. False, and nothing is in the block, where another vertex is shifted.
  bool pack(const double* rows, std::uint64_t first, std::uint64_t count,
            const std::vector<int>& shifted, Draws& block) const;

 private:
  void check_sheet(const double* row, std::uint64_t number) const;

  const PatternSource& source_;
  pybind11::array array_;
  bool is_ready_;  // to be taken as it is
  pybind11::array_t<double> made_;
  std::uint64_t sheets_;
  std::size_t per_sheet_;
};

/// The shifts of one sheet, [V, 2] in mm, as 2 x V. UserError (bad_request).
Eigen::Matrix2Xd shifts_of_one(const pybind11::object& shifts_mm, const PatternSource& source);

}  // namespace misalign::search::python
