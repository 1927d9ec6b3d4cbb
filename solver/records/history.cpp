#include "solver/records/history.hpp"

#include <utility>

#include "solver/records/base_history.hpp"
#include "solver/records/recorder.hpp"

namespace misalign::solver {

FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  if (model.has_spare_equations()) return record_on_base(model, vertices_mm, visit);
  PathFollower<double> follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, follower, visit);
  return std::move(recorder.record(SheetBlock(vertices_mm)).front());
}

FoldingHistory record_densely(const Model& model, const FlatVertices& vertices_mm) {
  HistoryObserver observer(model, lanes_of<double>());
  DenseFallback dense(model.mechanism());
  const SheetBlock sheet(vertices_mm);
  observer.begin(sheet);
  dense.follow(observer.queue(), observer);
  return std::move(observer.histories().front());
}

}  // namespace misalign::solver
