#include "solver/records/base_history.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cassert>
#include <optional>
#include <utility>

#include "solver/model/base_path.hpp"
#include "solver/records/history_observer.hpp"

namespace misalign::solver {
namespace {

// Bits of a reversal's angle: a millionth of a degree and better.
constexpr int kReversalBits = 40;

// Where the first diagonal turns back, deg; nothing where none does.
std::optional<double> first_reversal_deg(const FoldingHistory& history, const BasePath& path,
                                         const SheetGeometry<double>& geometry, PathPoint& point) {
  const Eigen::MatrixXd& slopes = history.slope_mm_per_deg;
  std::optional<double> first_deg;
  for (Eigen::Index d = 0; d < slopes.cols(); ++d) {
    const auto slope_at = [&](double pilot_deg) {
      path.find(geometry, half_angle_of_deg(pilot_deg), point);
      return point.slopes[static_cast<std::size_t>(d)];
    };
    for (Eigen::Index row = 1; row < slopes.rows(); ++row) {
      if (!(slopes(row - 1, d) * slopes(row, d) < 0)) continue;
      std::uintmax_t most = 100;
      const auto [from_deg, to_deg] = boost::math::tools::toms748_solve(
          slope_at, history.stations[static_cast<std::size_t>(row) - 1].pilot_deg,
          history.stations[static_cast<std::size_t>(row)].pilot_deg,
          boost::math::tools::eps_tolerance<double>(kReversalBits), most);
      if (!first_deg || from_deg < *first_deg) first_deg = 0.5 * (from_deg + to_deg);
      break;
    }
  }
  return first_deg;
}

}  // namespace

FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  assert(model.has_spare_equations());
  HistoryObserver observer(model, 1, visit);
  BasePath path(model.mechanism(), model.base());
  const SheetBlock sheet(vertices_mm);
  observer.begin(sheet);
  PathStart start{};
  observer.queue().next(start, 0);
  observer.begin_path(start, 0);
  FoldedPoints<double> points;
  for (const Station& station : model.path().stations) {
    if (!station.visit) continue;
    PathPoint& point = observer.point();
    path.find(*start.geometry, station.pilot, point);
    model.shape().place(*start.geometry, point.state, points);
    const double open_by = path.open_by(*start.geometry, point.state);
    observer.keep(
        station, 0,
        {open_by, path.singular_value(), model.shape().isometry_error(*start.geometry, points)});
  }
  observer.ended({PathEnd::end_reached, model.path().stations.back().pilot_deg, 0, 0, 0}, 0);
  FoldingHistory history = std::move(observer.histories().front());
  history.extremes.emplace();
  history.extremes->least_slope = history.between.least_slope;
  history.extremes->reverses_deg =
      first_reversal_deg(history, path, *start.geometry, observer.point());
  return history;
}

}  // namespace misalign::solver
