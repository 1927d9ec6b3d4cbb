// The angles at which a caller wants to see a path.
#pragma once

#include <pybind11/numpy.h>

#include <optional>
#include <vector>

#include "search/python/pattern_source.hpp"

namespace misalign::search::python {

/// Nothing for every sample. UserError (bad_request) unless they ascend: 0, then 0.01 to 180
/// degrees.
std::optional<std::vector<double>> stations_of(const pybind11::object& stations);

/// How far a path is followed to see these: beyond its own end where they lie there, but never
/// farther than the correct sheet folds.
schema::Sampling sampling_for(const std::optional<std::vector<double>>& stations_deg,
                              const PatternSource& source);

}  // namespace misalign::search::python
