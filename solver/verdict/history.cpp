#include "solver/verdict/history.hpp"

#include <algorithm>
#include <utility>

#include "solver/verdict/lane_recorder.hpp"

namespace misalign::solver {
namespace {

Eigen::MatrixXd rows_of(const std::vector<double>& values, std::size_t rows) {
  const Eigen::Index columns = static_cast<Eigen::Index>(rows > 0 ? values.size() / rows : 0);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows), columns);
}

class OneSheet final : public SheetBlock {
 public:
  explicit OneSheet(const FlatVertices& vertices_mm) : vertices_mm_(vertices_mm) {}
  int sheets() const override { return 1; }
  void place(int, FlatVertices& vertices_mm) const override { vertices_mm = vertices_mm_; }

 private:
  const FlatVertices& vertices_mm_;
};

}  // namespace

Recording::Recording(const Model& model, const StationVisitor* visit)
    : model_(model), visit_(visit), judge_(model.mechanism(), model.bump_is_fault()) {}

void Recording::begin(const FlatVertices& vertices_mm) {
  const Mechanism& mechanism = model_.mechanism();
  lengths_mm_.clear();
  slopes_mm_per_deg_.clear();
  angles_deg_.clear();
  history_ = {};
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  history_.flat_mm.resize(mechanism.diagonals.size());
  flat_lengths(mechanism, geometry, history_.flat_mm.data());
  judge_.begin(history_.flat_mm);
  for (double& length : history_.flat_mm) length *= mechanism.panel_width_mm;
}

void Recording::see(const Station& station, const PathPoint& point, const SolveQuality& quality) {
  const double width_mm = model_.mechanism().panel_width_mm;
  if (station.sample > 0) {
    judge_.see(station, point.state, point.lengths, &point.slopes, point.pilot_rate);
  }
  history_.stations.push_back(station);
  for (const double length : point.lengths) lengths_mm_.push_back(length * width_mm);
  for (const double slope : point.slopes) {
    slopes_mm_per_deg_.push_back(slope * width_mm * kRadPerDeg);
  }
  for (const auto& rho : point.state.creases) {
    angles_deg_.push_back(model_.mechanism().side * angle_deg(rho));
  }
  history_.open_by.push_back(quality.open_by);
  history_.singular_value_min.push_back(quality.singular_value_min);
  history_.isometry_error_mm.push_back(quality.isometry_error * width_mm);
  const std::vector<int>& samples = model_.margin_samples();
  if (std::binary_search(samples.begin(), samples.end(), station.sample)) {
    history_.margin_states.push_back(point.state);
  }
  if (visit_) (*visit_)(station, point.state);
}

FoldingHistory Recording::conclude(const PathResult& path) {
  history_.path = path;
  history_.verdict = judge_.conclude(path);
  history_.between = judge_.between();
  history_.length_mm = rows_of(lengths_mm_, history_.stations.size());
  history_.slope_mm_per_deg = rows_of(slopes_mm_per_deg_, history_.stations.size());
  history_.fold_angle_deg = rows_of(angles_deg_, history_.stations.size());
  return std::move(history_);
}

FoldingHistory record_history(const Model& model, const FlatVertices& vertices_mm,
                              const StationVisitor* visit) {
  PathFollower<double> follower(model.mechanism(), model.elimination());
  Recorder<double> recorder(model, follower, visit);
  return std::move(recorder.record(OneSheet(vertices_mm)).front());
}

FoldingHistory record_densely(const Model& model, const FlatVertices& vertices_mm) {
  RecordingObserver observer(model, 1);
  DenseFallback dense(model.mechanism());
  const OneSheet sheet(vertices_mm);
  observer.begin(sheet);
  dense.follow(observer);
  return std::move(observer.histories().front());
}

}  // namespace misalign::solver
