// Returns a sheet's path as arrays, with a row for each station.
#pragma once

#include <pybind11/pybind11.h>

#include "search/python/stations.hpp"

namespace misalign::search::python {

/// Follows the path of the sheet with these shifts (2 x vertices, mm). Returns the values of
/// `misalign fold` and `misalign replay`, with their JSON's names. Rows beyond the path's end are
/// NaN.
pybind11::dict fold(const PatternSource& source, const Eigen::Matrix2Xd& shifts_mm,
                    const std::optional<std::vector<double>>& stations_deg);

}  // namespace misalign::search::python
