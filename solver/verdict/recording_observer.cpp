#include "solver/verdict/recording_observer.hpp"

#include <utility>

namespace misalign::solver {

RecordingObserver::RecordingObserver(const Model& model, int lanes, const StationVisitor* visit)
    : model_(model),
      queue_(model, lanes),
      recordings_(lanes, Recording(model, visit)),
      point_(model.mechanism()),
      dense_state_(model.mechanism()),
      dense_follower_(model.mechanism()) {}

RecordingObserver::~RecordingObserver() = default;

void RecordingObserver::begin(const SheetBlock& block) {
  histories_.resize(static_cast<std::size_t>(block.sheets()));
  for_dense_.clear();
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
  if (!is_dense_) {
    if (is_for_dense_matrices(history.verdict, path)) for_dense_.push_back(sheet);
    histories_[sheet] = std::move(history);
    return;
  }
  const FoldingHistory& before = histories_[sheet];
  const bool counts = dense_verdict_counts(before.verdict, before.path, history.verdict);
  if (!counts && !before.path.lost()) return;
  // Where the path was lost past a fault, the fault stays said.
  if (!counts) history.verdict = before.verdict;
  histories_[sheet] = std::move(history);
}

void RecordingObserver::fall_back() {
  if (for_dense_.empty()) return;
  queue_.begin_again(for_dense_);
  is_dense_ = true;
  dense_follower_.run(*this);
  is_dense_ = false;
}

}  // namespace misalign::solver
