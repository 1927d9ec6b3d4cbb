#include "solver/continuation/homotopy.hpp"

namespace misalign::solver {
namespace {

// Shares at which the shifts pause: every tenth of them.
constexpr int kShares = 10;

// For the residual's rate of change with the share: error 1e-10 of it, which only bends the
// tangent.
constexpr double kDifference = 1e-5;

// Everything is as small as the pilot's angle at the first station.
CloseStepOptions options_for(const HalfAngle<double>& pilot) {
  const double unit_rad = 2 * pilot.s;
  CloseStepOptions options;
  // Creases at the first station may turn by this share of the pilot's own angle from one share to
  // the next: what goes farther has left the branch.
  options.longest_half_sine = 0.5 * pilot.s;
  options.least_tangent_cosine = 0.9;
  options.arc.longest_step_rad = 0.05 * unit_rad;
  options.arc.shortest_step_rad = 1e-7 * unit_rad;
  options.arc.least_tangent_cosine = 0.9;
  options.arc.most_steps = 2000;
  options.arc.limit_tolerance_rad = 1e-3 * unit_rad;
  return options;
}

// From no share to all of them, carried by angles from 0 to the pilot's at the first station.
PathPlan shares_of(const PathPlan& path, const Mechanism& mechanism) {
  PathPlan shares;
  const Station& first = path.stations.front();
  for (int k = 0; k <= kShares; ++k) {
    const double angle_deg = k == kShares ? first.pilot_deg : first.pilot_deg * k / kShares;
    shares.stations.push_back(
        {angle_deg, k == kShares ? first.pilot : half_angle_of_deg(angle_deg), 0, false});
  }
  shares.start = path.start;
  shares.start.creases[mechanism.pilot] = {1, 0};
  return shares;
}

struct EndOfPath {
  PathEnd end = PathEnd::start_lost;

  bool see(const Station&, int) { return true; }
  void ended(const PathResult& path, int) { end = path.end; }
};

}  // namespace

GrowingShifts::GrowingShifts(const Mechanism& mechanism, const HalfAngle<double>& pilot,
                             const FlatVertices& base_vertices_mm)
    : mechanism_(mechanism),
      pilot_(pilot),
      base_vertices_mm_(base_vertices_mm),
      system_(mechanism),
      before_(mechanism.equations),
      after_(mechanism.equations),
      jacobian_(system_.jacobian()) {}

void GrowingShifts::place_at(double share) {
  vertices_mm_ = base_vertices_mm_ + share * shifts_mm_;
  place(mechanism_, vertices_mm_, geometry_);
}

double GrowingShifts::evaluate(const SheetGeometry<double>&, const FoldState<double>& state) {
  const HalfAngle<double>& carrier = state.creases[mechanism_.pilot];
  const double share = carrier.s / pilot_.s;
  const double share_per_rad = 0.5 * carrier.c / pilot_.s;
  state_ = state;
  state_.creases[mechanism_.pilot] = pilot_;
  place_at(share - kDifference);
  solver::evaluate(mechanism_, geometry_, state_, before_.data(), nullptr);
  place_at(share + kDifference);
  solver::evaluate(mechanism_, geometry_, state_, after_.data(), nullptr);
  place_at(share);
  const double open_by = system_.evaluate(geometry_, state_);
  jacobian_ = system_.jacobian();
  for (int i = 0; i < mechanism_.equations; ++i) {
    jacobian_(i, mechanism_.unknowns - 1) =
        (after_[i] - before_[i]) / (2 * kDifference) * share_per_rad;
  }
  return open_by;
}

ShiftHomotopy::ShiftHomotopy(const Mechanism& mechanism, const PathPlan& plan,
                             const FlatVertices& base_vertices_mm)
    : mechanism_(mechanism),
      path_(plan),
      equations_(mechanism, plan.stations.front().pilot, base_vertices_mm),
      shares_(shares_of(plan, mechanism)),
      follower_(mechanism, DenseClosure(equations_), options_for(plan.stations.front().pilot)) {
  place(mechanism, base_vertices_mm, base_geometry_);
}

PathEnd ShiftHomotopy::find(const FlatVertices& vertices_mm) {
  equations_.begin(vertices_mm);
  EndOfPath path;
  follower_.follow({&base_geometry_, &shares_.start, &shares_}, path);
  state_ = follower_.state();
  state_.creases[mechanism_.pilot] = path_.stations.front().pilot;
  return path.end;
}

}  // namespace misalign::solver
