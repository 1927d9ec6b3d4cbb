#include "solver/records/base_history.hpp"

#include <cassert>
#include <utility>

#include "solver/judging/base_judge.hpp"
#include "solver/model/base_path.hpp"
#include "solver/records/history_observer.hpp"

namespace misalign::solver {

FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  assert(model.has_spare_equations());
  HistoryObserver observer(model, lanes_of<double>(), visit);
  BasePath path(model.mechanism(), model.base());
  const SheetBlock sheet(vertices_mm);
  observer.begin(sheet);
  PathStart start{};
  observer.queue().next(start, 0);
  observer.begin_path(start, 0);
  FoldedShape::Points<double> points;
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
  BaseJudge judge(model);
  history.verdict = judge.judge(vertices_mm);
  history.between = judge.between();
  history.extremes.emplace();
  history.extremes->least_slope = history.between.least_slope;
  history.extremes->reverses_deg = judge.reverses_deg();
  return history;
}

}  // namespace misalign::solver
