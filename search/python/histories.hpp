// Returns lengths of many sheets along their paths as one array.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "search/python/pattern_source.hpp"

namespace misalign::search::python {

/// Returns stations [S] in degrees, and lengths [N, S, G] in mm of the sheets with these shifts,
/// NaN beyond a path's end: the values of `misalign replay --json`.
pybind11::tuple histories_of(const PatternSource& source,
                             const std::vector<Eigen::Matrix2Xd>& shifts_mm);

}  // namespace misalign::search::python
