#include "solver/records/path_record.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

PathRecord record_of(const FoldingHistory& history, const Mechanism& mechanism) {
  const double width_mm = mechanism.panel_width_mm;
  assert(std::ssize(history.stations) == history.length_mm.rows());
  assert(history.open_by.size() == history.stations.size());
  PathRecord record;
  record.verdict = history.verdict;
  record.path = history.path;
  record.energy_deploys_from_sample = history.energy_deploys_from_sample;
  record.miscut_margin_mm = history.miscut_margin_mm;
  for (const double length_mm : history.flat_mm) record.flat.push_back(length_mm / width_mm);
  if (history.extremes) {
    record.extremes = *history.extremes;
  } else {
    record.extremes.least_slope = history.between.least_slope;
  }
  record.extremes.bump_where = history.between.bump_where;
  if (history.between.bump_where >= 0) record.extremes.bump_deg = history.between.bump_deg;
  for (std::size_t i = 0; i < history.stations.size(); ++i) {
    const int sample = history.stations[i].sample;
    if (sample == 0 || sample > history.verdict.deploys_from_sample) continue;
    const auto row = static_cast<Eigen::Index>(i);
    for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
      record.lengths.push_back(history.length_mm(row, d) / width_mm);
    }
    record.turning_mm.push_back(history.turning_mm[i]);
    record.singular_value_min = std::min(record.singular_value_min, history.singular_value_min[i]);
    record.residual_max = std::max(record.residual_max, history.open_by[i]);
    record.isometry_error =
        std::max(record.isometry_error, history.isometry_error_mm[i] / width_mm);
  }
  return record;
}

}  // namespace misalign::solver
