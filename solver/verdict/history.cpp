#include "solver/verdict/history.hpp"

#include <utility>

#include "solver/verdict/function_recorder.hpp"

namespace misalign::solver {

FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  PathFollower<double> follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, follower, visit);
  return std::move(recorder.record(SheetBlock(vertices_mm)).front());
}

PathRecord record_path(const Model& model, const FlatVertices& vertices_mm) {
  NodeFollower<double> node_follower(model.mechanism(), model.elimination());
  PathFollower<double> follower(model.mechanism(), model.elimination());
  FunctionRecorder<double> functions(model, node_follower, follower);
  Recorder<double> recorder(model, follower);
  return measure_paths(SheetBlock(vertices_mm), functions, recorder).front();
}

PathRecord record_of(const Model& model, const FlatVertices& vertices_mm,
                     const FoldingHistory& history) {
  PathRecord record = record_of(history, model.mechanism());
  const PathRecord function = record_path(model, vertices_mm);
  const bool is_whole = !function.lengths.empty();
  if (is_whole) record.extremes = function.extremes;
  return record;
}

FoldingHistory record_densely(const Model& model, const FlatVertices& vertices_mm) {
  RecordingObserver observer(model, 1);
  DenseFallback dense(model.mechanism());
  const SheetBlock sheet(vertices_mm);
  observer.begin(sheet);
  dense.follow(observer);
  return std::move(observer.histories().front());
}

}  // namespace misalign::solver
