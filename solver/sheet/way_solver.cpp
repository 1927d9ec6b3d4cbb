#include "solver/sheet/way_solver.hpp"

#include <cassert>

#include "solver/judging/sheet_queue.hpp"
#include "solver/linear/held_correction.hpp"
#include "solver/model/base_path.hpp"

namespace misalign::solver {
namespace {

// Angle of the state from which that of the first station is made.
constexpr double kFirst_deg = 2;

// Outlines a path with either follower.
class PathOutliner {
 public:
  PathOutliner(const Model& model, const FlatVertices& vertices_mm,
               PathFollower<double, LongSteps>& follower, PathFollower<double>& close_follower)
      : queue_(model, lanes_of<double>()),
        sheet_(vertices_mm),
        follower_(follower),
        close_follower_(close_follower),
        outline_{{}, flat_state<double>(model.mechanism()), 0} {}

  PathOutline find() {
    queue_.begin(sheet_);
    follower_.run(queue_, *this);
    if (!outline_.path.lost()) return outline_;
    outline_.near_deg = 0;
    queue_.begin(sheet_);
    close_follower_.run(queue_, *this);
    return outline_;
  }

  // Called by the followers.
  ObserverResult see(const PathFunction& function, int) {
    near_states_.clear();
    if (!outline_.has_near() && function.pilot(function.end()) > kFirst_deg * kRadPerDeg) {
      near_states_.push_back({function.locate(kFirst_deg * kRadPerDeg), &outline_.near});
      outline_.near_deg = kFirst_deg;
    }
    return ObserverResult::go_on;
  }
  bool see(const Station& station, int) {
    if (outline_.has_near()) return true;
    outline_.near = close_follower_.state();
    outline_.near_deg = station.pilot_deg;
    return true;
  }
  void ended(PathResult path, int lane) {
    near_states_.clear();
    if (queue_.has_ended(path, lane)) outline_.path = path;
  }
  const std::vector<NearState>& near_states() const { return near_states_; }

 private:
  SheetQueue queue_;
  const SheetBlock sheet_;
  PathFollower<double, LongSteps>& follower_;
  PathFollower<double>& close_follower_;
  PathOutline outline_;
  std::vector<NearState> near_states_;
};

// The states of one path at a plan's stations, closed once more, and their rates.
class StationKeeper {
 public:
  StationKeeper(const Model& model, const PathStart& start, PathFollower<double>& follower)
      : mechanism_(model.mechanism()),
        start_(start),
        follower_(follower),
        factors_(model.elimination()),
        residual_(static_cast<std::size_t>(mechanism_.unknowns)),
        work_(residual_),
        turn_(residual_) {}

  std::vector<WayStation> keep() {
    follower_.follow(start_, *this);
    return std::move(stations_);
  }

  // Called by the follower.
  bool see(const Station&, int) {
    WayStation& station = stations_.emplace_back(WayStation{follower_.state(), residual_});
    correct_held(mechanism_, *start_.geometry, true, factors_, residual_, work_, turn_,
                 station.state);
    factors_.null_vector(-factors_.pilot_coefficient() / factors_.partner_coefficient(), 1.0,
                         work_.data(), station.rates.data());
    return true;
  }
  void ended(const PathResult&, int) {}

 private:
  const Mechanism& mechanism_;
  const PathStart start_;
  PathFollower<double>& follower_;
  SparseLu<double> factors_;
  std::vector<double> residual_, work_, turn_;
  std::vector<WayStation> stations_;
};

}  // namespace

PathOutline outline_path(const Model& model, const FlatVertices& vertices_mm,
                         PathFollower<double, LongSteps>& follower,
                         PathFollower<double>& close_follower) {
  return PathOutliner(model, vertices_mm, follower, close_follower).find();
}

std::optional<FoldingWay> solve_way(const Model& model, const FlatVertices& vertices_mm,
                                    const PathOutline& outline, int station_count,
                                    PathFollower<double>& close_follower) {
  if (!outline.has_near()) return {};
  assert(station_count >= SmoothTable::kPoints);
  const double end_rad = outline.path.fold_limit_deg * kRadPerDeg;
  const WayCoordinate coordinate{outline.path.end == PathEnd::fold_limit ? end_rad : 0};
  const double end = coordinate.x_of(end_rad), step = end / station_count;

  SheetGeometry<double> geometry;
  place(model.mechanism(), vertices_mm, geometry);
  PathPlan plan;
  for (int k = 0; k < station_count; ++k) {
    const double pilot_deg = coordinate.pilot_rad((k + 0.5) * step) / kRadPerDeg;
    plan.stations.push_back({pilot_deg, half_angle_of_deg(pilot_deg), 0, true});
  }
  const FoldState<double> near =
      in_proportion(outline.near, plan.stations.front().pilot_deg / outline.near_deg);
  std::vector<WayStation> stations =
      StationKeeper(model, {&geometry, &near, &plan}, close_follower).keep();
  const std::size_t solved = stations.size();
  assert(solved <= plan.stations.size());
  if (2 * solved < plan.stations.size() || solved < SmoothTable::kPoints) return {};
  for (std::size_t k = 0; k < solved; ++k) {
    const double rate = coordinate.pilot_rate((static_cast<double>(k) + 0.5) * step);
    for (double& of_unknown : stations[k].rates) of_unknown *= rate;
  }
  const bool is_whole = solved == plan.stations.size() && !outline.path.lost();
  const double last = (static_cast<double>(solved) - 0.5) * step;
  return FoldingWay(model.mechanism(), vertices_mm, coordinate, step, is_whole ? end : last,
                    std::move(stations));
}

FoldingWay way_on_base(const Model& model, const FlatVertices& vertices_mm, int station_count) {
  assert(station_count >= SmoothTable::kPoints && !model.path().stations.empty());
  const BasePath path(model.mechanism(), model.base());
  const double end = model.path().stations.back().pilot_deg * kRadPerDeg;
  const double step = end / station_count;
  std::vector<WayStation> stations(static_cast<std::size_t>(station_count));
  for (int k = 0; k < station_count; ++k) {
    const HalfAngle<double> pilot = half_angle_of_deg((k + 0.5) * step / kRadPerDeg);
    WayStation& station = stations[static_cast<std::size_t>(k)];
    path.find_state(pilot, station.state);
    path.find_rates(pilot, station.rates);
  }
  return FoldingWay(model.mechanism(), vertices_mm, {0}, step, end, std::move(stations));
}

}  // namespace misalign::solver
