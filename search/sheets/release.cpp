#include "search/sheets/release.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "schema/files/user_error.hpp"
#include "schema/pattern/fill_words.hpp"
#include "search/sheets/springs_at_vertices.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::search {
namespace {

using schema::shown_number;
using schema::UserError;

double start_deg(const solver::Sheet& sheet, const SimulationStart& options) {
  const double deploys_from_deg = sheet.deploys_from_deg();
  if (!options.from_deg && deploys_from_deg <= 0) {
    throw UserError(schema::Cause::bad_request,
                    sheet.name() +
                        " does not deploy (D = 0), so it has no usual angle of release; name one "
                        "with " +
                        schema::parameter("from_deg"));
  }
  return options.from_deg.value_or(std::min(solver::kDeployFrom_deg, deploys_from_deg));
}

[[noreturn]] void refuse(const char* option, double pilot_deg, const std::string& why) {
  throw UserError(
      solver::OptionFault{option, shown_number(pilot_deg), why, "name a smaller angle"});
}

// Returns the pattern if its unshifted sheet folds that far.
const schema::Pattern& pattern_for(const schema::Pattern& base, const char* option,
                                   double pilot_deg, const std::string& name) {
  const double end_deg = base.base.folding.end_deg();
  if (pilot_deg > end_deg) {
    refuse(option, pilot_deg,
           name + " folds to " + shown_number(end_deg) + " deg only, even unshifted");
  }
  return base;
}

struct FoldedSheet {
  Eigen::Matrix3Xd shape_mm;
  std::vector<double> fold_angle_deg;
};

// Folds the sheet to a pilot angle, which an option named: followed closely, so that every fault
// before it is found.
FoldedSheet folded_to(const FoldingModel& model, const solver::Sheet& sheet, const char* option,
                      double pilot_deg) {
  // One sample is enough; the path takes shorter steps where it needs them.
  FoldingModel to_angle(pattern_for(model.base(), option, pilot_deg, sheet.name()),
                        {pilot_deg, pilot_deg}, model.design());
  const solver::Sheet folded = to_angle.sheet(sheet.shifts_mm(), sheet.name());
  const solver::FoldingHistory& history = folded.history();
  const auto rows = static_cast<Eigen::Index>(history.stations.size());
  if (!folded.row_at(pilot_deg)) {
    const std::string limit_deg = shown_number(history.path.fold_limit_deg);
    refuse(option, pilot_deg,
           sheet.name() + (history.path.lost() ? " could not be followed that far"
                                               : " has its fold limit at " + limit_deg + " deg"));
  }
  if (solver::rows_folded_well(to_angle.mechanism(), history) < rows) {
    refuse(option, pilot_deg,
           sheet.name() + " has panels that passed through each other before that");
  }
  std::vector<Eigen::Index> all(history.stations.size());
  std::iota(all.begin(), all.end(), 0);
  check_shapes(folded, all);
  const Eigen::VectorXd last_deg = history.fold_angle_deg.row(rows - 1);
  return {folded.shapes_mm().back(), {last_deg.begin(), last_deg.end()}};
}

Eigen::Matrix3Xd flat_shape(const solver::FlatVertices& vertices_mm) {
  Eigen::Matrix3Xd shape_mm = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
  shape_mm.topRows<2>() = vertices_mm;
  return shape_mm;
}

}  // namespace

schema::SimulatedSheet release(const FoldingModel& model, const solver::Sheet& sheet,
                               const SimulationStart& options, const std::string& title) {
  need_springs_at_vertices(sheet.base().springs, "simulations by other programs");
  const solver::Fill fill = model.actuators().fill;
  schema::need_plain_springs(fill, "simulations by other programs");
  const auto& springs = std::get<solver::Springs>(fill);
  if (const solver::Preload& preload = springs.preload; preload.is_any()) {
    throw UserError(solver::OptionFault{
        "preload_n", shown_number(preload.largest_n()),
        "is not known to files of other programs, whose springs are relaxed at an angle",
        "add " + schema::parameter("preload_n", "0") + " for springs that are relaxed when flat"});
  }
  const double from_deg = start_deg(sheet, options);
  FoldedSheet start = folded_to(model, sheet, "from_deg", from_deg);
  std::vector<std::array<int, 2>> places;
  for (const int facet : sheet.panels().facets) {
    places.push_back(model.base().base.sheet.places[static_cast<std::size_t>(facet)]);
  }
  return {title,
          sheet.mechanism(),
          sheet.panels(),
          std::move(places),
          sheet.vertices_mm(),
          from_deg,
          std::move(start.shape_mm),
          std::move(start.fold_angle_deg),
          options.plates,
          springs.stiffness_n_per_mm,
          options.rest_deg,
          options.rest_deg > 0 ? folded_to(model, sheet, "rest_deg", options.rest_deg).shape_mm
                               : flat_shape(sheet.vertices_mm())};
}

}  // namespace misalign::search
