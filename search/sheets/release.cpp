#include "search/sheets/release.hpp"

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
    throw UserError(schema::Cause::bad_request,
                    name +
                        " deploys from no angle, so none is where it would be let go by itself; "
                        "name one with --from");
  }
  return options.from_deg.value_or(std::min(kDeployFrom_deg, deploys_from_deg));
}

[[noreturn]] void refuse(const std::string& option, double pilot_deg, const std::string& name,
                         const std::string& why) {
  throw UserError(schema::Cause::bad_request, option + " " + shown_number(pilot_deg) + ": " + name +
                                                  " " + why + "; name a smaller angle");
}

// The pattern, if its unshifted sheet folds that far.
const schema::Pattern& pattern_for(const schema::Pattern& base, const std::string& option,
                                   double pilot_deg, const std::string& name) {
  const double end_deg = base.base.folding.end_deg();
  if (pilot_deg > end_deg) {
    refuse(option, pilot_deg, name,
           "folds to " + shown_number(end_deg) + " deg only, even unshifted");
  }
  return base;
}

// The sheet where its pilot has an angle, which an option named.
class StateAt {
 public:
  StateAt(const SheetFolder& folder, const FoldedSheet& folded, const std::string& option,
          double pilot_deg, const std::string& name)
      // One sample is enough; the path takes shorter steps where it needs them.
      : folder_(pattern_for(folder.base(), option, pilot_deg, name), {pilot_deg, pilot_deg},
                folder.actuators()),
        folded_(folder_.fold(folded.shifts_mm)) {
    const solver::FoldingHistory& history = folded_.path.history;
    row_ = static_cast<Eigen::Index>(history.stations.size()) - 1;
    if (row_ < 0 || std::abs(history.stations[row_].pilot_deg - pilot_deg) > 1e-9) {
      refuse(option, pilot_deg, name,
             history.path.lost()
                 ? "could not be followed that far"
                 : "has its fold limit at " + shown_number(history.path.fold_limit_deg) + " deg");
    }
    if (solver::rows_folded_well(folder_.mechanism(), history) <= row_) {
      refuse(option, pilot_deg, name, "has panels that passed through each other before that");
    }
    std::vector<Eigen::Index> rows(history.stations.size());
    std::iota(rows.begin(), rows.end(), 0);
    folder_.check_shapes(folded_, rows, name);
  }

  const solver::Mechanism& mechanism() const { return folder_.mechanism(); }
  const Eigen::Matrix3Xd& shape_mm() const {
    return folded_.path.shapes_mm[static_cast<std::size_t>(row_)];
  }
  std::vector<double> fold_angle_deg() const {
    const Eigen::VectorXd angles_deg = folded_.path.history.fold_angle_deg.row(row_);
    return {angles_deg.begin(), angles_deg.end()};
  }

 private:
  const SheetFolder folder_;
  const FoldedSheet folded_;
  Eigen::Index row_ = -1;
};

Eigen::Matrix3Xd flat_shape(const solver::FlatVertices& vertices_mm) {
  Eigen::Matrix3Xd shape_mm = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
  shape_mm.topRows<2>() = vertices_mm;
  return shape_mm;
}

}  // namespace

schema::SimulatedSheet release(const SheetFolder& folder, const FoldedSheet& folded,
                               const ReleaseOptions& options, const std::string& title,
                               const std::string& name) {
  const double from_deg = start_deg(folder, folded, options, name);
  const StateAt start(folder, folded, "--from", from_deg, name);
  const schema::Pattern& base = folder.base();
  solver::Panels panels = solver::panels_of(base.base, start.mechanism());
  std::vector<std::array<int, 2>> places;
  for (const int facet : panels.facets) places.push_back(base.base.sheet.places[facet]);
  return {title,
          start.mechanism(),
          std::move(panels),
          std::move(places),
          folded.vertices_mm,
          from_deg,
          start.shape_mm(),
          start.fold_angle_deg(),
          options.plates,
          folder.actuators().stiffness_n_per_mm,
          options.rest_deg,
          options.rest_deg > 0
              ? StateAt(folder, folded, "--rest-deg", options.rest_deg, name).shape_mm()
              : flat_shape(folded.vertices_mm)};
}

}  // namespace misalign::search
