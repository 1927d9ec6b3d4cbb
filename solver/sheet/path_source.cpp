#include "solver/sheet/path_source.hpp"

#include <cassert>
#include <utility>

#include "solver/linear/newton.hpp"
#include "solver/records/function_recorder.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::solver {
namespace {

class FollowedPaths : public PathSource {
 public:
  explicit FollowedPaths(const Model& model)
      : model_(model),
        follower_(model.mechanism(), model.elimination()),
        close_follower_(model.mechanism(), model.elimination()),
        recorder_(model, close_follower_, &keep_),
        functions_(model, follower_, close_follower_, recorder_) {}

  std::optional<PathRecord> record(const FlatVertices& vertices_mm) override {
    ++followed_.as_functions;
    PathRecord record = functions_.record(SheetBlock(vertices_mm)).front();
    states_.clear();  // those of a path that had to be followed closely are not used
    assert(record.flat.size() == model_.mechanism().diagonals.size());
    return record;
  }

  FoldingHistory history(const FlatVertices& vertices_mm,
                         std::vector<WayStation>& states) override {
    ++followed_.closely;
    states_.clear();
    FoldingHistory history = std::move(recorder_.record(SheetBlock(vertices_mm)).front());
    assert(states_.size() >= history.stations.size());
    states_.resize(history.stations.size());
    states = std::exchange(states_, {});
    return history;
  }

  std::optional<FoldingWay> way(const FlatVertices& vertices_mm,
                                std::shared_ptr<const PathOutline>& outline,
                                int stations) override {
    if (!outline) {
      ++followed_.as_functions;
      outline = std::make_shared<PathOutline>(
          outline_path(model_, vertices_mm, follower_, close_follower_));
    }
    if (outline->has_near()) ++followed_.closely;
    return solve_way(model_, vertices_mm, *outline, stations, close_follower_);
  }

  bool close(const SheetGeometry<double>& geometry, FoldState<double>& state) override {
    return Newton(model_.mechanism()).correct(geometry, state).end == Newton::StopReason::converged;
  }

 private:
  const Model& model_;
  PathFollower<double, LongSteps> follower_;
  PathFollower<double> close_follower_;
  std::vector<WayStation> states_;  // along the path that is recorded
  const StationVisitor keep_ = [this](const Station&, const PathPoint& point) {
    states_.push_back({point.state, point.rates});
  };
  Recorder<double> recorder_;
  FunctionRecorder<double> functions_;
};

class PathsOnBase : public PathSource {
 public:
  explicit PathsOnBase(const Model& model) : model_(model) {}

  std::optional<PathRecord> record(const FlatVertices&) override { return {}; }

  FoldingHistory history(const FlatVertices& vertices_mm,
                         std::vector<WayStation>& states) override {
    states.clear();
    const StationVisitor keep = [&](const Station&, const PathPoint& point) {
      states.push_back({point.state, point.rates});
    };
    return record_on_base(model_, vertices_mm, &keep);
  }

  std::optional<FoldingWay> way(const FlatVertices& vertices_mm,
                                std::shared_ptr<const PathOutline>&, int stations) override {
    return way_on_base(model_, vertices_mm, stations);
  }

  bool close(const SheetGeometry<double>&, FoldState<double>&) override { return true; }

 private:
  const Model& model_;
};

}  // namespace

std::unique_ptr<PathSource> path_source_of(const Model& model) {
  if (model.is_overconstrained()) return std::make_unique<PathsOnBase>(model);
  return std::make_unique<FollowedPaths>(model);
}

}  // namespace misalign::solver
