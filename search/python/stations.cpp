#include "search/python/stations.hpp"

#include <algorithm>

#include "search/python/arrays.hpp"

namespace misalign::search::python {

namespace py = pybind11;

// Least station: closer to flat, where all branches meet, a path may be lost.
constexpr double kLeast_deg = 0.01;

std::optional<std::vector<double>> stations_of(const py::object& stations) {
  if (stations.is_none()) return std::nullopt;
  const auto refuse = [](const std::string& why) {
    return schema::UserError(
        schema::Cause::bad_request,
        "stations: " + why + "; give pilot angles in degrees, ascending, from 0 to 180");
  };
  const py::array all = array_of_given(stations, "stations", "atleast_1d");
  const char kind = all.dtype().kind();
  if (all.ndim() != 1) throw refuse("has " + std::to_string(all.ndim()) + " axes, not one");
  if (all.size() == 0) throw refuse("is empty");
  if (kind != 'f' && kind != 'i' && kind != 'u') throw refuse("holds values that are no numbers");
  const auto list = numbers_of<double>(all);
  const std::vector<double> angles_deg(list.data(), list.data() + list.size());
  for (std::size_t k = 0; k < angles_deg.size(); ++k) {
    if (angles_deg[k] != 0 && !(angles_deg[k] >= kLeast_deg && angles_deg[k] <= 180)) {
      throw refuse("holds " + schema::shown_number(angles_deg[k]));
    }
    if (k > 0 && !(angles_deg[k] > angles_deg[k - 1])) {
      throw refuse("has " + schema::shown_number(angles_deg[k]) + " after " +
                   schema::shown_number(angles_deg[k - 1]));
    }
  }
  return angles_deg;
}

schema::Sampling sampling_for(const std::optional<std::vector<double>>& stations_deg,
                              const PatternSource& source) {
  schema::Sampling sampling = source.sheet.sampling;
  if (stations_deg) sampling.end_deg = std::max(sampling.end_deg, stations_deg->back());
  sampling.end_deg = std::min(sampling.end_deg, source.sheet.base.base.folding.end_deg());
  return sampling;
}

}  // namespace misalign::search::python
