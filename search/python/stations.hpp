// Reads the stations of a path that a caller requests.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <vector>

#include "search/python/pattern_source.hpp"

namespace misalign::search::python {

/// Returns the stations; nothing means every sample. UserError (bad_request) unless they ascend: 0,
/// then 0.01 to 180 degrees.
std::optional<std::vector<double>> stations_of(const pybind11::object& stations);

/// Returns the sampling that reaches these stations: beyond the path's end if needed, but no
/// farther than the correct sheet folds.
schema::Sampling sampling_for(const std::optional<std::vector<double>>& stations_deg,
                              const PatternSource& source);

}  // namespace misalign::search::python
