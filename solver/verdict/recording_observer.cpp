#include "solver/verdict/recording_observer.hpp"

#include <utility>

namespace misalign::solver {

RecordingObserver::RecordingObserver(const Model& model, int lanes, const StationVisitor* visit)
    : model_(model),
      queue_(model, lanes),
      recordings_(lanes, Recording(model, visit)),
      point_(model.mechanism()),
      dense_state_(model.mechanism()),
      fallback_(model.mechanism()) {}

RecordingObserver::~RecordingObserver() = default;

void RecordingObserver::begin(const SheetBlock& block) {
  histories_.resize(static_cast<std::size_t>(block.sheets()));
  fallback_.begin();
  queue_.begin(block);
}

bool RecordingObserver::next(PathStart& start, int lane) {
  if (!queue_.put_next(start, lane)) return false;
  recordings_[lane].begin(queue_.vertices_mm());
  return true;
}

bool RecordingObserver::see(const Station& station, int lane) {
  place(model_.mechanism(), queue_.vertices_mm_of_lane(lane), geometry_);
  dense_state_.find(geometry_, point_.state, point_);
  model_.shape().place(geometry_, point_.state, points_);
  recordings_[lane].see(station, point_,
                        {dense_state_.open_by(), dense_state_.singular_value(),
                         model_.shape().isometry_error(geometry_, points_)});
  return true;
}

void RecordingObserver::ended(PathResult path, int lane) {
  if (!queue_.has_ended(path, lane)) return;
  const int sheet = queue_.of_lane(lane);
  FoldingHistory history = recordings_[lane].conclude(path);
  if (!fallback_.under_way()) {
    fallback_.consider(sheet, history.verdict, path);
  } else if (!fallback_.counts(sheet, history.verdict)) {
    const FoldingHistory& before = histories_[sheet];
    if (!before.path.lost()) return;
    history.verdict = before.verdict;  // of what was seen before
  }
  histories_[sheet] = std::move(history);
}

}  // namespace misalign::solver
