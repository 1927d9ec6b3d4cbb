#include "solver/history.hpp"

#include "solver/recording_client.hpp"
#include "solver/tracker.hpp"

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
  SingleRecording(const Mechanism& mechanism, const FoldedShape& shape, const PathPlan& plan,
                  const FlatVertices& vertices_mm)
      : plan_(plan), recording_(mechanism, shape) {
    recording_.begin(vertices_mm);
  }
  bool next(Departure& departure, int) {
    if (departed_) return false;
    departed_ = true;
    departure = {&recording_.geometry(), &plan_.start, &plan_};
    return true;
  }
  Recording& of_lane(int) { return recording_; }
  void ended(const PathResult& path, int) { history_ = recording_.conclude(path); }
  FoldingHistory take() { return std::move(history_); }

 private:
  const PathPlan& plan_;
  bool departed_ = false;
  Recording recording_;
  FoldingHistory history_;
};

}  // namespace

Recording::Recording(const Mechanism& mechanism, const FoldedShape& shape)
    : mechanism_(mechanism), shape_(shape), judge_(mechanism), residual_(mechanism.equations) {}

void Recording::begin(const FlatVertices& vertices_mm) {
  vertices_mm_ = vertices_mm;
  place(mechanism_, vertices_mm_, geometry_);
  lengths_mm_.clear();
  angles_deg_.clear();
  history_ = {};
  history_.flat_mm.resize(mechanism_.diagonals.size());
  flat_lengths(mechanism_, geometry_, history_.flat_mm.data());
  judge_.begin(history_.flat_mm);
  for (double& length : history_.flat_mm) length *= mechanism_.panel_width_mm;
}

void Recording::see(const Stop& stop, const FoldState<double>& state,
                    const std::vector<double>& lengths, double singular_value_min) {
  if (stop.sample > 0) judge_.see(stop, state, lengths);
  history_.stops.push_back(stop);
  for (const double length : lengths) lengths_mm_.push_back(length * mechanism_.panel_width_mm);
  for (const auto& rho : state.creases) angles_deg_.push_back(angle_deg(rho));
  history_.open_by.push_back(evaluate(mechanism_, geometry_, state, residual_.data(), nullptr));
  history_.singular_value_min.push_back(singular_value_min);
  history_.isometry_error_mm.push_back(
      shape_.isometry_error_mm(vertices_mm_, shape_.vertices_mm(geometry_, state)));
}

FoldingHistory Recording::conclude(const PathResult& path) {
  history_.path = path;
  history_.verdict = judge_.conclude(path);
  history_.length_mm = rows_of(lengths_mm_, history_.stops.size());
  history_.fold_angle_deg = rows_of(angles_deg_, history_.stops.size());
  return std::move(history_);
}

FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm) {
  const Elimination elimination = plan_elimination(mechanism, base.folding, base.sheet.vertices_mm);
  const FoldedShape shape(base.sheet, base.holes, mechanism);
  Tracker<double> tracker(mechanism, elimination);
  SingleRecording single(mechanism, shape, plan, vertices_mm);
  RecordingClient<double, SingleRecording> client(mechanism, tracker, single);
  tracker.run(client);
  FoldingHistory history = single.take();
  return history.lost() ? record_densely(mechanism, shape, plan, vertices_mm) : history;
}

FoldingHistory record_densely(const Mechanism& mechanism, const FoldedShape& shape,
                              const PathPlan& plan, const FlatVertices& vertices_mm) {
  Recording recording(mechanism, shape);
  recording.begin(vertices_mm);
  PathTracker tracker(mechanism);
  ClosureSystem system(mechanism);
  DenseSolve factors(mechanism.equations);
  SmallestSingularValue<double> smallest(mechanism.equations);
  std::vector<double> lengths(mechanism.diagonals.size());
  const PathResult path = tracker.follow(
      recording.geometry(), plan, [&](const Stop& stop, const FoldState<double>& state) {
        system.evaluate(recording.geometry(), state);
        factors.factorize(system.jacobian().leftCols(mechanism.equations));
        folded_lengths(mechanism, recording.geometry(), state, lengths.data());
        recording.see(stop, state, lengths, smallest.of(factors));
        return true;
      });
  return recording.conclude(path);
}

}  // namespace misalign::solver
