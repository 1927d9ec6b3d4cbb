#include "solver/verdict/history.hpp"

#include <algorithm>
#include <utility>

#include "solver/continuation/homotopy.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/verdict/dense_state.hpp"
#include "solver/verdict/lane_recorder.hpp"
#include "solver/verdict/miscut_margin.hpp"

namespace misalign::solver {
namespace {

Eigen::MatrixXd rows_of(const std::vector<double>& values, std::size_t rows) {
  const Eigen::Index columns = static_cast<Eigen::Index>(rows > 0 ? values.size() / rows : 0);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows), columns);
}

// One sheet for a tracker of one lane.
class SingleRecording {
 public:
  SingleRecording(const Mechanism& mechanism, const PathPlan& plan, const FlatVertices& vertices_mm,
                  StartFinder& finder, const RecordingOptions& options)
      : plan_(plan),
        vertices_mm_(vertices_mm),
        finder_(finder),
        start_(&plan.start),
        recording_(mechanism, options) {
    place(mechanism, vertices_mm, geometry_);
  }
  bool next(Departure& departure, int) {
    if (!start_) return false;
    recording_.begin(vertices_mm_);
    departure = {&geometry_, std::exchange(start_, nullptr), &plan_};
    return true;
  }
  Recording& of_lane(int) { return recording_; }
  // Where the base folding is too far off, once more from a start that is found from there.
  void ended(PathResult path, int) {
    if (path.end == PathEnd::start_lost && !has_searched_) {
      has_searched_ = true;
      const StartEnd end = finder_.find(vertices_mm_);
      if (end == StartEnd::branch_ended) path.end = PathEnd::fold_limit;
      if (end == StartEnd::found) {
        start_ = &finder_.state();
        return;
      }
    }
    history_ = recording_.conclude(path);
  }
  FoldingHistory take() { return std::move(history_); }

 private:
  const PathPlan& plan_;
  const FlatVertices& vertices_mm_;
  StartFinder& finder_;
  const FoldState<double>* start_;  // to depart from next
  bool has_searched_ = false;
  SheetGeometry<double> geometry_;
  Recording recording_;
  FoldingHistory history_;
};

}  // namespace

Recording::Recording(const Mechanism& mechanism, RecordingOptions options)
    : mechanism_(mechanism),
      visit_(std::move(options.visit)),
      margin_samples_(std::move(options.margin_samples)),
      judge_(mechanism, options.bump_is_fault) {}

void Recording::begin(const FlatVertices& vertices_mm) {
  vertices_mm_ = vertices_mm;
  lengths_mm_.clear();
  slopes_mm_per_deg_.clear();
  angles_deg_.clear();
  history_ = {};
  SheetGeometry<double> geometry;
  place(mechanism_, vertices_mm_, geometry);
  history_.flat_mm.resize(mechanism_.diagonals.size());
  flat_lengths(mechanism_, geometry, history_.flat_mm.data());
  judge_.begin(history_.flat_mm);
  for (double& length : history_.flat_mm) length *= mechanism_.panel_width_mm;
}

void Recording::see(const SeenStop& seen) {
  const double width_mm = mechanism_.panel_width_mm;
  if (seen.stop.sample > 0) {
    judge_.see(seen.stop, seen.state, seen.lengths, &seen.slopes, seen.pilot_rate);
  }
  history_.stops.push_back(seen.stop);
  for (const double length : seen.lengths) lengths_mm_.push_back(length * width_mm);
  for (const double slope : seen.slopes) {
    slopes_mm_per_deg_.push_back(slope * width_mm * kRadPerDeg);
  }
  for (const auto& rho : seen.state.creases)
    angles_deg_.push_back(mechanism_.side * angle_deg(rho));
  history_.open_by.push_back(seen.open_by);
  history_.singular_value_min.push_back(seen.singular_value_min);
  history_.isometry_error_mm.push_back(seen.isometry_error * width_mm);
  if (std::binary_search(margin_samples_.begin(), margin_samples_.end(), seen.stop.sample)) {
    history_.margin_states.push_back(seen.state);
  }
  if (visit_) visit_(seen.stop, seen.state);
}

void Recording::see_densely(const Stop& stop, const FoldState<double>& state,
                            const FoldedShape& shape) {
  if (!dense_) dense_ = std::make_shared<DenseLook>(mechanism_);
  SheetGeometry<double> geometry;
  place(mechanism_, vertices_mm_, geometry);
  dense_->at(geometry, state);
  FoldedPoints<double> points;
  shape.place(geometry, dense_->state(), points);
  see({stop, dense_->state(), dense_->lengths(), dense_->slopes(), dense_->pilot_rate(),
       dense_->open_by(), dense_->singular_value(), shape.isometry_error(geometry, points)});
}

FoldingHistory Recording::conclude(const PathResult& path) {
  history_.path = path;
  history_.verdict = judge_.conclude(path);
  history_.between = judge_.between();
  history_.length_mm = rows_of(lengths_mm_, history_.stops.size());
  history_.slope_mm_per_deg = rows_of(slopes_mm_per_deg_, history_.stops.size());
  history_.fold_angle_deg = rows_of(angles_deg_, history_.stops.size());
  return std::move(history_);
}

// False turns were seen within 1e-4 degrees of 180.
bool is_for_dense_to_confirm(const Verdict& verdict, const PathResult& path) {
  return verdict.first_fault == Fault::fold_limit && path.fold_limit_deg > 180 - 1e-3;
}

FoldingHistory confirmed(FoldingHistory history, const Mechanism& mechanism,
                         const FoldedShape& shape, const PathPlan& plan,
                         const FlatVertices& vertices_mm, const RecordingOptions& options) {
  if (!history.lost() && !is_for_dense_to_confirm(history.verdict, history.path)) return history;
  FoldingHistory dense = record_densely(mechanism, shape, plan, vertices_mm, options);
  if (!history.lost()) return dense.verdict.first_fault == Fault::undecided ? history : dense;
  // What was known of its samples before it was lost stays said.
  if (history.verdict.first_fault != Fault::undecided) dense.verdict = history.verdict;
  return dense;
}

FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm,
                              const RecordingOptions& options) {
  return record_history(base, mechanism,
                        plan_elimination(mechanism, base.folding, base.sheet.vertices_mm), plan,
                        vertices_mm, options);
}

FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const Elimination& elimination, const PathPlan& plan,
                              const FlatVertices& vertices_mm, const RecordingOptions& options) {
  const FoldedShape shape(base.sheet, base.holes, mechanism);
  Tracker<double> tracker(mechanism, elimination);
  StartFinder finder(mechanism, elimination, plan, base.sheet.vertices_mm);
  SingleRecording single(mechanism, plan, vertices_mm, finder, options);
  RecordingClient<double, SingleRecording> client(mechanism, shape, tracker, single);
  tracker.run(client);
  FoldingHistory history = confirmed(single.take(), mechanism, shape, plan, vertices_mm, options);
  if (!options.margin_samples.empty() &&
      history.margin_states.size() == options.margin_samples.size()) {
    history.miscut_margin_mm =
        miscut_margin_mm(mechanism, elimination, vertices_mm, history.margin_states);
  }
  return history;
}

FoldingHistory record_densely(const Mechanism& mechanism, const FoldedShape& shape,
                              const PathPlan& plan, const FlatVertices& vertices_mm,
                              const RecordingOptions& options) {
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  Recording recording(mechanism, options);
  recording.begin(vertices_mm);
  PathTracker tracker(mechanism);
  const PathResult path =
      tracker.follow(geometry, plan, [&](const Stop& stop, const FoldState<double>& state) {
        recording.see_densely(stop, state, shape);
        return true;
      });
  return recording.conclude(path);
}

}  // namespace misalign::solver
