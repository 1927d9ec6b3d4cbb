#include "solver/certificate/path_tube.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

double PathTube::isolation() const {
  double least = 1;
  assert(std::ssize(path) >= radii.size() && radii.minCoeff() > 0);
  for (Eigen::Index i = 0; i < radii.size(); ++i) {
    least = std::min(least, 0.9 * radii[i] - path[i].radius);
  }
  return least;
}

bool join(const PathTube& before, const PathTube& after) {
  const double at_deg = after.chart.interval().from_deg;
  assert(at_deg == before.chart.interval().to_deg && "an interval begins where the last one ends");
  assert(before.radii.size() == after.radii.size());
  const Ball s = before.chart.place_of(at_deg), s_after = after.chart.place_of(at_deg);
  std::vector<Ball> x(before.radii.size());
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = value_at(before.path[j], s);
  const std::vector<Ball> same = after.chart.unknowns(before.chart.plain(x, at_deg), at_deg);
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double apart = (same[j] - polynomial_at(after.path[j], s_after)).bound();
    if (!(apart < after.radii[static_cast<Eigen::Index>(j)])) return false;
  }
  return true;
}

}  // namespace misalign::solver
