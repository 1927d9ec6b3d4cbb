#include "solver/sheet/followed_base.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <utility>

#include "solver/continuation/path_follower.hpp"
#include "solver/kinematics/folded_shape.hpp"
#include "solver/kinematics/measured_state.hpp"
#include "solver/linear/pivoted_closure.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {
namespace {

// Steps of the pilot; finer ones from where these do not lead on, to tell a limit point from a
// sharp bend of the path.
constexpr double kFollowedStep_deg = 1, kFineStep_deg = 0.05;
// The two pilot angles at which fold angles are compared next to flat, where they are odd functions
// of the pilot's and hence in proportion, and the largest deviation as a share of the lesser angle.
constexpr double kNextToFlat_deg = 1, kHalfOfThat_deg = 0.5;
constexpr double kOutOfProportion = 0.2;
// The folding of a base that has a fold limit ends this far beyond it: a path with a station there
// ends at the limit, not at a singular state.
constexpr double kBeyondLimit_deg = 1e-4;

// Base states are rounded to this, far above the error of dense matrices: the same bits on every
// machine. Followers correct it at their first station.
constexpr double kPlacesOfState = 1 << 26;

double rounded(double value) { return std::round(value * kPlacesOfState) / kPlacesOfState; }

// A way as the folding of a base.
class WayAsFolding : public FollowedFolding {
 public:
  WayAsFolding(const Mechanism& mechanism, const FlatVertices& flat_mm,
               const WayCoordinate& coordinate, double step, double end,
               std::vector<WayStation> stations)
      : mechanism_(mechanism),
        way_(mechanism_, flat_mm, coordinate, step, end, std::move(stations)) {}

  FoldState<double> state(const HalfAngle<double>& pilot) const override {
    FoldState<double> state = flat_state<double>(mechanism_);
    find(angle_deg(pilot), state);
    for (HalfAngle<double>& rho : state.creases) {
      rho = half_angle_of_ratio(rounded(rho.s), rounded(rho.c));
    }
    for (Quaternion<double>& q : state.balls) {
      q = Quaternion<double>{rounded(q.w), rounded(q.x), rounded(q.y), rounded(q.z)}.normalized();
    }
    state.creases[static_cast<std::size_t>(mechanism_.pilot)] = pilot;
    return state;
  }

  std::vector<HalfAngle<double>> fold_angles(const HalfAngle<double>& pilot) const override {
    std::vector<HalfAngle<double>> angles(mechanism_.edges.size(), {1, 0});
    const FoldState<double> at = state(pilot);
    for (std::size_t k = 0; k < at.creases.size(); ++k) {
      angles[static_cast<std::size_t>(mechanism_.creases[k].edge)] = at.creases[k];
    }
    return angles;
  }

  // The state without rounding.
  void find(double pilot_deg, FoldState<double>& state) const {
    const std::scoped_lock locked(lock_);
    way_.find_state(way_.x_of(pilot_deg), state);
  }

 private:
  const Mechanism mechanism_;
  const FoldingWay way_;
  mutable std::mutex lock_;  // of the way's scratch memory
};

// The linkage with its pilot a valley at the folded state; mountains and valleys are not known.
Mechanism linkage(const CreasePattern& sheet, const std::vector<int>& holes, int pilot_edge,
                  const FoldedVertices& folded_mm) {
  const auto seen_from = [&](int side) {
    return build_mechanism(
        {sheet, holes, BaseFolding(pilot_edge, side, std::vector<int>(sheet.edges.size(), 0))});
  };
  Mechanism mechanism = seen_from(1);
  const FoldState<double> folded = measured_state(mechanism, sheet, folded_mm);
  const bool is_valley = folded.creases[static_cast<std::size_t>(mechanism.pilot)].s > 0;
  return is_valley ? mechanism : seen_from(-1);
}

class TargetFollower {
 public:
  TargetFollower(const CreasePattern& sheet, const std::vector<int>& holes, int pilot_edge,
                 const FoldedVertices& folded_mm)
      : sheet_(sheet),
        holes_(holes),
        mechanism_(linkage(sheet, holes, pilot_edge, folded_mm)),
        target_(measured_state(mechanism_, sheet, folded_mm)),
        target_deg_(angle_deg(target_.creases[static_cast<std::size_t>(mechanism_.pilot)])),
        system_(mechanism_),
        newton_(mechanism_),
        square_(system_),
        follower_(mechanism_, PivotedClosure(system_)) {
    assert(mechanism_.unknowns == mechanism_.equations + 1);
    place(mechanism_, sheet.vertices_mm, geometry_);
  }

  std::variant<FollowedBase, NoFollowedBase> find() {
    using Cause = NoFollowedBase::Cause;
    if (newton_.correct(geometry_, target_).end != Newton::StopReason::converged) {
      return NoFollowedBase{Cause::open, target_deg_};
    }
    follow(target_, way_down(target_deg_, kFollowedStep_deg));
    if (path_.end != PathEnd::end_reached && !states_.empty()) {
      const FoldState<double> last = states_.back();
      follow(last, way_down(path_.fold_limit_deg, kFineStep_deg));
    }
    if (path_.end != PathEnd::end_reached) {
      return NoFollowedBase{Cause::turns, path_.fold_limit_deg};
    }
    assert(states_.size() >= 2);
    const FoldState<double> near = states_[states_.size() - 2];
    if (const auto crease = out_of_proportion(near, states_.back())) return *crease;
    follow(target_, way_up());
    return from_flat(near);
  }

  // Called by the follower.
  bool see(const Station&, int) {
    states_.push_back(follower_.state());
    return true;
  }
  void ended(const PathResult& path, int) { path_ = path; }

 private:
  static void add(double pilot_deg, PathPlan& plan) {
    plan.stations.push_back({pilot_deg, half_angle_of_deg(pilot_deg), 0, true});
  }

  static PathPlan way_down(double from_deg, double step_deg) {
    PathPlan plan;
    add(from_deg, plan);
    for (double k = std::ceil(from_deg / step_deg) - 1; k * step_deg > kNextToFlat_deg; --k) {
      add(k * step_deg, plan);
    }
    add(kNextToFlat_deg, plan);
    add(kHalfOfThat_deg, plan);
    return plan;
  }

  PathPlan way_up() const {
    PathPlan plan;
    add(target_deg_, plan);
    for (double k = std::floor(target_deg_ / kFollowedStep_deg) + 1; k * kFollowedStep_deg <= 180;
         ++k) {
      add(k * kFollowedStep_deg, plan);
    }
    return plan;
  }

  void follow(const FoldState<double>& start, const PathPlan& plan) {
    states_.clear();
    follower_.follow({&geometry_, &start, &plan}, *this);
  }

  // The crease that is not in proportion next to flat.
  std::optional<NoFollowedBase> out_of_proportion(const FoldState<double>& near,
                                                  const FoldState<double>& nearer) const {
    for (std::size_t k = 0; k < near.creases.size(); ++k) {
      const double at_deg = angle_deg(nearer.creases[k]);
      const double off_deg =
          std::abs(angle_deg(near.creases[k]) - kNextToFlat_deg / kHalfOfThat_deg * at_deg);
      if (off_deg <= kOutOfProportion * std::max(std::abs(at_deg), kHalfOfThat_deg)) continue;
      return NoFollowedBase{NoFollowedBase::Cause::not_flat, kHalfOfThat_deg,
                            mechanism_.creases[k].edge, mechanism_.side * at_deg};
    }
    return std::nullopt;
  }

  // The path from flat through the target to its end, at the stations of a way.
  std::variant<FollowedBase, NoFollowedBase> from_flat(const FoldState<double>& near) {
    const double end_rad = path_.fold_limit_deg * kRadPerDeg;
    const WayCoordinate coordinate{path_.end == PathEnd::fold_limit ? end_rad : 0};
    const double end = coordinate.x_of(end_rad), step = end / kWayStations;
    const auto x_of_station = [&](int k) { return (k + 0.5) * step; };
    PathPlan plan;
    for (int k = 0; k < kWayStations; ++k) {
      add(coordinate.pilot_rad(x_of_station(k)) / kRadPerDeg, plan);
    }
    const FoldState<double> first =
        in_proportion(near, plan.stations.front().pilot_deg / kNextToFlat_deg);
    follow(first, plan);
    const std::size_t solved = states_.size();
    if (solved < plan.stations.size() &&
        (solved < SmoothTable::kPoints || plan.stations[solved - 1].pilot_deg < target_deg_)) {
      return NoFollowedBase{NoFollowedBase::Cause::lost, path_.fold_limit_deg};
    }
    std::vector<WayStation> stations;
    for (std::size_t k = 0; k < solved; ++k) {
      stations.push_back(
          closed(states_[k], coordinate.pilot_rate(x_of_station(static_cast<int>(k)))));
    }
    const double last =
        solved == plan.stations.size() ? end : x_of_station(static_cast<int>(solved) - 1);
    const auto way = std::make_shared<const WayAsFolding>(
        mechanism_, sheet_.vertices_mm, coordinate, step, last, std::move(stations));
    const bool is_limit = coordinate.limit_rad > 0 && last == end;
    const double end_deg = coordinate.pilot_rad(last) / kRadPerDeg;
    return joined(near, end_deg + (is_limit ? kBeyondLimit_deg : 0), way);
  }

  WayStation closed(FoldState<double> state, double pilot_rate) {
    newton_.correct(geometry_, state);
    system_.evaluate(geometry_, state);
    square_.factorize();
    const Eigen::VectorXd others = square_.solve(-system_.column(mechanism_.equations));
    std::vector<double> rates(static_cast<std::size_t>(mechanism_.unknowns), pilot_rate);
    for (Eigen::Index k = 0; k < others.size(); ++k) {
      rates[static_cast<std::size_t>(k)] = others(k) * pilot_rate;
    }
    return {std::move(state), std::move(rates)};
  }

  std::variant<FollowedBase, NoFollowedBase> joined(
      const FoldState<double>& near, double end_deg,
      const std::shared_ptr<const WayAsFolding>& way) {
    FoldState<double> there = target_;
    way->find(target_deg_, there);
    newton_.correct(geometry_, there);
    const FoldedShape shape(sheet_, holes_, mechanism_);
    const double apart_mm =
        (shape.vertices_mm(geometry_, there) - shape.vertices_mm(geometry_, target_))
            .colwise()
            .norm()
            .maxCoeff();
    if (!(apart_mm <= kJoined_widths * sheet_.panel_width_mm)) {
      return NoFollowedBase{NoFollowedBase::Cause::apart, target_deg_, -1, 0, apart_mm};
    }
    std::vector<int> assignment(sheet_.edges.size(), 0);
    for (std::size_t k = 0; k < near.creases.size(); ++k) {
      assignment[static_cast<std::size_t>(mechanism_.creases[k].edge)] =
          near.creases[k].s < 0 ? -1 : 1;
    }
    const int pilot_edge = mechanism_.creases[static_cast<std::size_t>(mechanism_.pilot)].edge;
    return FollowedBase{
        BaseFolding(pilot_edge, mechanism_.side, std::move(assignment), end_deg, way), target_deg_,
        apart_mm};
  }

  const CreasePattern& sheet_;
  const std::vector<int>& holes_;
  const Mechanism mechanism_;
  FoldState<double> target_;
  const double target_deg_;
  SheetGeometry<double> geometry_;
  ClosureSystem system_;
  Newton newton_;
  PivotedJacobian square_;
  PathFollower<double, CloseSteps, PivotedClosure<ClosureSystem>> follower_;
  std::vector<FoldState<double>> states_;
  PathResult path_{};
};

}  // namespace

std::variant<FollowedBase, NoFollowedBase> follow_from_target(const CreasePattern& sheet,
                                                              const std::vector<int>& holes,
                                                              int pilot_edge,
                                                              const FoldedVertices& folded_mm) {
  return TargetFollower(sheet, holes, pilot_edge, folded_mm).find();
}

}  // namespace misalign::solver
