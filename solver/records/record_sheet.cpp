#include "solver/records/record_sheet.hpp"

#include <cassert>
#include <utility>

#include "solver/judging/base_judge.hpp"
#include "solver/model/base_path.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  if (model.is_overconstrained()) return record_on_base(model, vertices_mm, visit);
  PathFollower<double> follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, follower, visit);
  return std::move(recorder.record(SheetBlock(vertices_mm)).front());
}

FoldingHistory record_with_pivoting(const Model& model, const FlatVertices& vertices_mm) {
  HistoryObserver observer(model, lanes_of<double>());
  PivotedFallback pivoted(model.mechanism());
  const SheetBlock sheet(vertices_mm);
  observer.begin(sheet);
  pivoted.follow(observer.queue(), observer);
  return std::move(observer.histories().front());
}

FoldingHistory record_on_base(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  assert(model.is_overconstrained());
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
