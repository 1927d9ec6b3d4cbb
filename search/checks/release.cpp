#include "search/checks/release.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace misalign::search {
namespace {

using schema::shown_number;
using schema::UserError;

double start_deg(const SheetFolder& folder, const FoldedSheet& folded,
                 const ReleaseOptions& options, const std::string& name) {
  const double deploys_from_deg =
      folded.path.history.verdict.deploys_from_sample * folder.sampling().sample_deg;
  if (!options.from_deg && deploys_from_deg <= 0) {
    throw UserError(schema::kExitUsage,
                    name +
                        " deploys from no angle, so none is where it would be let go by itself; "
                        "name one with --from");
  }
  return options.from_deg.value_or(std::min(kDeployFrom_deg, deploys_from_deg));
}

void refuse(const std::string& name, double from_deg, const std::string& why) {
  throw UserError(schema::kExitUsage, "--from " + shown_number(from_deg) + ": " + name + " " + why +
                                          "; name a smaller angle");
}

}  // namespace

schema::SimulatedSheet release(const SheetFolder& folder, const FoldedSheet& folded,
                               const ReleaseOptions& options, const std::string& title,
                               const std::string& name) {
  const double from_deg = start_deg(folder, folded, options, name);
  const schema::Pattern& base = folder.base();
  if (from_deg > base.base.folding.end_deg()) {
    refuse(name, from_deg,
           "folds to " + shown_number(base.base.folding.end_deg()) + " deg only, even unshifted");
  }
  // One sample is enough; the path takes shorter steps where it needs them.
  const SheetFolder to_start(base, {from_deg, from_deg}, folder.actuators());
  FoldedSheet start = to_start.fold(folded.shifts_mm);
  const solver::FoldingHistory& history = start.path.history;
  const auto row = static_cast<Eigen::Index>(history.stations.size()) - 1;
  if (row < 0 || std::abs(history.stations[row].pilot_deg - from_deg) > 1e-9) {
    refuse(name, from_deg,
           history.path.lost()
               ? "could not be followed that far"
               : "has its fold limit at " + shown_number(history.path.fold_limit_deg) + " deg");
  }
  if (solver::rows_folded_well(to_start.mechanism(), history) <= row) {
    refuse(name, from_deg, "has panels that passed through each other before that");
  }
  std::vector<Eigen::Index> rows(history.stations.size());
  std::iota(rows.begin(), rows.end(), 0);
  to_start.check_shapes(start, rows, name);
  const Eigen::VectorXd angles_deg = history.fold_angle_deg.row(row);
  solver::Panels panels = solver::panels_of(base.base, to_start.mechanism());
  std::vector<std::array<int, 2>> places;
  for (const int facet : panels.facets) places.push_back(base.base.sheet.places[facet]);
  return {title,
          to_start.mechanism(),
          std::move(panels),
          std::move(places),
          start.vertices_mm,
          from_deg,
          std::move(start.path.shapes_mm[static_cast<std::size_t>(row)]),
          {angles_deg.begin(), angles_deg.end()},
          options.plates,
          folder.actuators().stiffness_n_per_mm};
}

}  // namespace misalign::search
