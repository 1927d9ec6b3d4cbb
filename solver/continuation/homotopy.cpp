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

GrowingShifts::GrowingShifts(const Mechanism& mechanism, const Elimination& elimination,
                             const HalfAngle<double>& pilot, const FlatVertices& base_vertices_mm)
    : mechanism_(mechanism),
      pilot_(pilot),
      base_vertices_mm_(base_vertices_mm),
      lu_(elimination),
      residual_(static_cast<std::size_t>(mechanism.unknowns)),
      before_(residual_),
      after_(residual_),
      of_residual_(residual_),
      of_share_(residual_),
      work_(residual_) {}

void GrowingShifts::place_at(double share) {
  vertices_mm_ = base_vertices_mm_ + share * shifts_mm_;
  place(mechanism_, vertices_mm_, geometry_);
}

double GrowingShifts::linearize(const FoldState<double>& state) {
  const HalfAngle<double>& carrier = state.creases[mechanism_.pilot];
  const double share = carrier.s / pilot_.s;
  const double per_difference = 0.5 * carrier.c / pilot_.s / (2 * kDifference);
  state_ = state;
  state_.creases[mechanism_.pilot] = pilot_;
  place_at(share - kDifference);
  evaluate(mechanism_, geometry_, state_, before_.data(), nullptr);
  place_at(share + kDifference);
  evaluate(mechanism_, geometry_, state_, after_.data(), nullptr);
  place_at(share);
  const double open_by = evaluate(mechanism_, geometry_, state_, residual_.data(), lu_.entries());
  lu_.factorize(residual_.data(), of_residual_.data());
  for (std::size_t i = 0; i < after_.size(); ++i)
    after_[i] = (after_[i] - before_[i]) * per_difference;
  lu_.forward(after_.data(), of_share_.data());
  return open_by;
}

void GrowingShifts::solve(double is_free, double* x, double* null) {
  const std::size_t last = static_cast<std::size_t>(mechanism_.equations) - 1;
  const double of_partner = lu_.partner_coefficient(), of_share = of_share_[last];
  const bool holds_share = is_free <= 0 || std::abs(of_partner) >= std::abs(of_share);
  solve_with(1, holds_share ? of_residual_[last] / of_partner : 0,
             holds_share ? 0 : of_residual_[last] / of_share, x);
  solve_with(0, -of_share, of_partner, null);
}

// So many times the residual, less the share's column: for a share and a partner that satisfy the
// equation that is left.
void GrowingShifts::solve_with(double of_residual, double partner, double share, double* x) {
  for (std::size_t i = 0; i < work_.size(); ++i) {
    work_[i] = of_residual * of_residual_[i] - share * of_share_[i];
  }
  lu_.backward(work_.data(), partner, 0.0, x);
  x[mechanism_.unknowns - 1] = share;
}

ShiftHomotopy::ShiftHomotopy(const Mechanism& mechanism, const Elimination& elimination,
                             const PathPlan& plan, const FlatVertices& base_vertices_mm)
    : mechanism_(mechanism),
      path_(plan),
      shifts_(mechanism, elimination, plan.stations.front().pilot, base_vertices_mm),
      shares_(shares_of(plan, mechanism)),
      follower_(mechanism, ShareClosure{&shifts_}, options_for(plan.stations.front().pilot)) {
  place(mechanism, base_vertices_mm, base_geometry_);
}

PathEnd ShiftHomotopy::find(const FlatVertices& vertices_mm) {
  shifts_.begin(vertices_mm);
  EndOfPath path;
  follower_.follow({&base_geometry_, &shares_.start, &shares_}, path);
  state_ = follower_.state();
  state_.creases[mechanism_.pilot] = path_.stations.front().pilot;
  return path.end;
}

}  // namespace misalign::solver
