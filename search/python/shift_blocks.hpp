// Takes shifts of many sheets, [N, V, 2] in mm, from NumPy, block by block for the lanes.
#pragma once

#include <pybind11/numpy.h>

#include "search/draws/draw_evaluator.hpp"
#include "search/python/pattern_source.hpp"

namespace misalign::search::python {

class ShiftBlocks {
 public:
  /// Requires the GIL. UserError (bad_request) for any other array. Other types and strides are
  /// converted to doubles block by block.
  ShiftBlocks(const pybind11::object& shifts_mm, const PatternSource& source);

  std::uint64_t sheets() const { return sheets_; }
  /// Returns `count` sheets from `first` on; requires the GIL. Valid until the next call.
  const double* rows(std::uint64_t first, std::uint64_t count);

  /// Returns the amplitude if all shifts are ternary, else 0. Looks at the first sheets alone.
  double ternary_mm();

  /// Writes the shifts of these vertices into `block`, numbered from `first` on; needs no GIL.
  /// UserError (bad_request) for the first sheet with shifts that are not finite, or a facet that
  /// is not convex. Returns false, with an empty block, if another vertex is shifted.
  bool pack(const double* rows, std::uint64_t first, std::uint64_t count,
            const std::vector<int>& shifted, Draws& block) const;

 private:
  void check_sheet(const double* row, std::uint64_t number) const;

  const PatternSource& source_;
  pybind11::array array_;
  bool is_ready_;  // contiguous doubles, used in place
  pybind11::array_t<double> made_;
  std::uint64_t sheets_;
  std::size_t per_sheet_;
};

/// Returns the shifts of one sheet, [V, 2] in mm, as 2 x V. UserError (bad_request).
Eigen::Matrix2Xd shifts_of_one(const pybind11::object& shifts_mm, const PatternSource& source);

}  // namespace misalign::search::python
