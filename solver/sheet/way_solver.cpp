#include <algorithm>
#include <cmath>

#include "solver/continuation/node_follower.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/judging/sheet_queue.hpp"
#include "solver/linear/held_correction.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {
namespace {

// The state with which the stations begin is made from the one here.
constexpr double kFirst_deg = 2;

// A state near flat with every joint turned `share` times as far: near the path's own there, since
// its fold angles are in proportion to the pilot's to second order.
FoldState<double> in_proportion(const FoldState<double>& state, double share) {
  FoldState<double> other = state;
  for (HalfAngle<double>& rho : other.creases) {
    const double half = share * std::atan2(rho.s, rho.c);
    rho = {std::cos(half), std::sin(half)};
  }
  for (Quaternion<double>& q : other.balls) {
    q = Quaternion<double>{q.w, share * q.x, share * q.y, share * q.z}.normalized();
  }
  return other;
}

// Where one sheet's path ends, and a state of it near flat, from either follower.
class PathEndFinder {
 public:
  PathEndFinder(const Model& model, const FlatVertices& vertices_mm)
      : queue_(model, 1), sheet_(vertices_mm), near_(flat_state<double>(model.mechanism())) {}

  void find(NodeFollower<double>& follower, PathFollower<double>& close_follower) {
    node_follower_ = &follower;
    queue_.begin(sheet_);
    follower.run(*this);
    if (!path_.lost()) return;
    node_follower_ = nullptr;
    close_follower_ = &close_follower;
    near_deg_ = 0;
    queue_.begin(sheet_);
    close_follower.run(*this);
  }
  /// Whether there is a state near flat; and one in proportion to it.
  bool has_near() const { return near_deg_ > 0; }
  FoldState<double> near(double pilot_deg) const {
    return in_proportion(near_, pilot_deg / near_deg_);
  }
  const PathResult& path() const { return path_; }

  // For the followers.
  bool next(PathStart& start, int lane) { return queue_.put_next(start, lane); }
  ObserverResult see(const PathFunction& function, int lane) {
    if (!has_near() && function.pilot(function.end()) > kFirst_deg * kRadPerDeg) {
      node_follower_->find_state(function.locate(kFirst_deg * kRadPerDeg), lane, near_);
      near_deg_ = kFirst_deg;
    }
    return ObserverResult::go_on;
  }
  bool see(const Station& station, int) {
    if (has_near()) return true;
    near_ = close_follower_->state();
    near_deg_ = station.pilot_deg;
    return true;
  }
  void ended(PathResult path, int lane) {
    if (queue_.has_ended(path, lane)) path_ = path;
  }

 private:
  SheetQueue queue_;
  const SheetBlock sheet_;
  const NodeFollower<double>* node_follower_ = nullptr;
  const PathFollower<double>* close_follower_ = nullptr;
  FoldState<double> near_;
  double near_deg_ = 0;
  PathResult path_{};
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
    follower_.run(*this);
    return std::move(stations_);
  }

  // For the follower.
  bool next(PathStart& start, int) {
    if (handed_out_) return false;
    start = start_;
    return handed_out_ = true;
  }
  bool see(const Station&, int) {
    WayStation& here = stations_.emplace_back(WayStation{follower_.state(), residual_});
    correct_held(mechanism_, *start_.geometry, true, factors_, residual_, work_, turn_, here.state);
    factors_.null_vector(-factors_.pilot_coefficient() / factors_.partner_coefficient(), 1.0,
                         work_.data(), here.rates.data());
    return true;
  }
  void ended(const PathResult&, int) {}

 private:
  const Mechanism& mechanism_;
  const PathStart start_;
  PathFollower<double>& follower_;
  bool handed_out_ = false;
  SparseLu<double> factors_;
  std::vector<double> residual_, work_, turn_;
  std::vector<WayStation> stations_;
};

}  // namespace

struct WaySolver::Workspace {
  explicit Workspace(const Model& model)
      : nodes(model.mechanism(), model.elimination()),
        closely(model.mechanism(), model.elimination()) {}
  NodeFollower<double> nodes;
  PathFollower<double> closely;
};

WaySolver::WaySolver(const Model& model, const FoldingWayOptions& options)
    : model_(model), options_(options), workspace_(std::make_unique<Workspace>(model)) {}

WaySolver::~WaySolver() = default;

std::optional<FoldingWay> WaySolver::follow(const FlatVertices& vertices_mm) {
  const Mechanism& mechanism = model_.mechanism();
  PathEndFinder ahead(model_, vertices_mm);
  ahead.find(workspace_->nodes, workspace_->closely);
  if (!ahead.has_near()) return {};
  const double end_rad = ahead.path().fold_limit_deg * kRadPerDeg;
  const WayCoordinate coordinate{ahead.path().end == PathEnd::fold_limit ? end_rad : 0};
  const double end = coordinate.x_of(end_rad), step = end / options_.stations;

  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  PathPlan plan;
  for (int k = 0; k < options_.stations; ++k) {
    const double pilot_deg = coordinate.pilot_rad((k + 0.5) * step) / kRadPerDeg;
    plan.stations.push_back({pilot_deg, half_angle_of_deg(pilot_deg), 0, true});
  }
  const FoldState<double> near = ahead.near(plan.stations.front().pilot_deg);
  std::vector<WayStation> stations =
      StationKeeper(model_, {&geometry, &near, &plan}, workspace_->closely).keep();
  const std::size_t solved = stations.size();
  if (2 * solved < plan.stations.size() || solved < SmoothTable::kPoints) return {};
  for (std::size_t k = 0; k < solved; ++k) {
    const double rate = coordinate.pilot_rate((static_cast<double>(k) + 0.5) * step);
    for (double& of_unknown : stations[k].rates) of_unknown *= rate;
  }
  const bool is_whole = solved == plan.stations.size() && !ahead.path().lost();
  const double last = (static_cast<double>(solved) - 0.5) * step;
  return FoldingWay(mechanism, vertices_mm, coordinate, step, is_whole ? end : last,
                    std::move(stations));
}

}  // namespace misalign::solver
