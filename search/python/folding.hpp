// One sheet's path as arrays, a row for each station.
#pragma once

#include <pybind11/pybind11.h>

#include "search/python/stations.hpp"

namespace misalign::search::python {

/// Follows the path of the sheet with these shifts (2 x vertices, mm); what `misalign fold` and
/// `misalign replay` say of it, under the names of their JSON. Rows beyond the path's end are NaN.
pybind11::dict fold(const PatternSource& source, const Eigen::Matrix2Xd& shifts_mm,
                    const std::optional<std::vector<double>>& stations_deg);

}  // namespace misalign::search::python
