#include "solver/bending/bent_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Largest displacement of the last correction.
constexpr double kLastStep_widths = 1e-10;
// A correction's factors serve the next one where no vertex moved farther than this, and than this
// share of the correction before.
constexpr double kNear_widths = 1e-5, kFast = 0.1;
// Number of corrections of one step, and the share of the predicted displacement that all together
// may have. Single ones tell little: a thin panel that the prediction stretches first moves to and
// fro.
constexpr int kMostCorrectionsOfStep = 12;
constexpr double kCloseness = 0.5;
// Number of steps from one load to the other, and the shortest as a share of the way.
constexpr int kMostBendSteps = 200;
constexpr double kLeastBendStep = 1.0 / 512;
// Relative error of a filling's forces on panels that bend linearly, and the number of Newton steps
// to it: one for springs, some where plates begin to wrinkle.
constexpr double kForceError = 1e-12;
constexpr int kMostStepsOfForces = 30;

std::vector<int> coordinates_but(Index count, const std::vector<int>& held) {
  std::vector<int> free;
  for (int i = 0; i < count; ++i) {
    if (!std::binary_search(held.begin(), held.end(), i)) free.push_back(i);
  }
  return free;
}

}  // namespace

// A u + lambda g = r, g . u = c, with A's null vector along which g changes: by A + beta g g^T,
// which is positive where A is so on all u with g . u = 0.
class HeldStiffness {
 public:
  HeldStiffness(const Eigen::MatrixXd& a, const Eigen::VectorXd& g);
  bool is_positive() const { return is_positive_; }

  // Columns of L^-1 r without the component of the held sum: their products are r^T A^-1 r.
  Eigen::MatrixXd lower(const Eigen::MatrixXd& r) const;
  Eigen::MatrixXd upper(const Eigen::MatrixXd& lower) const;

  struct Step {
    Eigen::VectorXd u;
    double lambda;
  };
  Step solve(const Eigen::VectorXd& r, double c) const;

 private:
  Eigen::VectorXd g_;
  double beta_;
  bool is_positive_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
  Eigen::VectorXd lower_g_;
};

HeldStiffness::HeldStiffness(const MatrixXd& a, const VectorXd& g) : g_(g) {
  assert(a.rows() == a.cols() && a.rows() == g.size());
  beta_ = a.diagonal().mean() / g.squaredNorm();
  MatrixXd b = a;
  b.selfadjointView<Eigen::Lower>().rankUpdate(g, beta_);
  factors_.compute(b);
  is_positive_ = factors_.info() == Eigen::Success;
  if (is_positive_) lower_g_ = factors_.matrixL().solve(g);
}

MatrixXd HeldStiffness::lower(const MatrixXd& r) const {
  assert(is_positive_ && r.rows() == g_.size());
  MatrixXd lower = factors_.matrixL().solve(r);
  lower -= lower_g_ * (lower_g_.transpose() * lower) / lower_g_.squaredNorm();
  return lower;
}

MatrixXd HeldStiffness::upper(const MatrixXd& lower) const {
  return factors_.matrixU().solve(lower);
}

HeldStiffness::Step HeldStiffness::solve(const VectorXd& r, double c) const {
  assert(is_positive_ && r.size() == g_.size());
  const VectorXd lower = factors_.matrixL().solve(r);
  const double mu = (lower_g_.dot(lower) - c) / lower_g_.squaredNorm();
  return {factors_.matrixU().solve(lower - mu * lower_g_), mu + beta_ * c};
}

BentFollower::BentFollower(const ElasticSheet& sheet, const Filling& filling,
                           const Matrix3Xd& folded_mm)
    : sheet_(sheet),
      filling_(filling),
      free_(coordinates_but(sheet.coordinates(), sheet.supports(folded_mm))),
      load_{sheet.turned_mm(folded_mm), filling.forces_n(sheet.lengths_mm(folded_mm))} {
  state_.at_mm = folded_mm;
  state_.squares_mm2 = sheet.squares_mm2(folded_mm, 0 * folded_mm);
  assert(folded_mm.cols() == sheet.vertices());
  assert(std::ssize(free_) == sheet.coordinates() - 6 && "the first panel is held still");
}

BentFollower::~BentFollower() = default;

bool BentFollower::follow(double turned_mm) {
  if (!held_ && !correct(load_, sheet_.panel_width_mm(), state_)) return false;
  const Load from = load_;
  // The remaining share of the way to the new load.
  double left = turned_mm == from.turned_mm && from.relief_n.isZero(0) ? 0 : 1;
  int steps = 0;
  for (double share = 1; left > 0; share = std::min(2 * share, left)) {
    const auto rate = held_->solve(
        sheet_.length_slopes(state_.at_mm)(Eigen::all, free_).transpose() * -from.relief_n,
        turned_mm - from.turned_mm);
    for (;; share /= 2) {
      if (share < kLeastBendStep || ++steps > kMostBendSteps) return false;
      const double to = left > share ? 1 - left + share : 1;
      const Load load{from.turned_mm + to * (turned_mm - from.turned_mm), (1 - to) * from.relief_n};
      State next = state_;
      next.moment_n -= share * rate.lambda;
      const double moved_mm = move(share * rate.u, next);
      if (!correct(load, moved_mm, next)) continue;
      state_ = std::move(next);
      load_ = load;
      left = left > share ? left - share : 0;
      break;
    }
  }
  ElasticSheet::Energy energy =
      sheet_.panels_energy(state_.at_mm, state_.squares_mm2, ElasticSheet::Derivatives::first);
  sheet_.add_filling(state_.at_mm, filling_, load_.relief_n, energy);
  state_.n_mm = energy.n_mm;
  state_.forces_n = filling_.forces_n(sheet_.lengths_mm(state_.at_mm));
  state_.saddles_mm = sheet_.saddles_mm(state_.at_mm);
  return true;
}

// Returns whether Newton's method reaches a stable state close to a prediction whose displacements
// are at most `moved_mm`.
bool BentFollower::correct(const Load& load, double moved_mm, State& state) {
  using Derivatives = ElasticSheet::Derivatives;
  const double width_mm = sheet_.panel_width_mm(), enough_mm = kLastStep_widths * width_mm;
  const Matrix3Xd predicted_mm = state.at_mm;
  std::unique_ptr<const HeldStiffness> held;
  double before_mm = width_mm;  // the last correction's largest displacement
  for (int k = 0; k < kMostCorrectionsOfStep; ++k) {
    ElasticSheet::Energy energy = sheet_.panels_energy(
        state.at_mm, state.squares_mm2, held ? Derivatives::first : Derivatives::second);
    sheet_.add_filling(state.at_mm, filling_, load.relief_n, energy);
    const VectorXd turned_slope = sheet_.turned_slope(state.at_mm)(free_);
    if (!held) {
      sheet_.add_turned_bend(state.at_mm, -state.moment_n, energy.bend);
      held = std::make_unique<const HeldStiffness>(energy.bend(free_, free_), turned_slope);
      if (!held->is_positive()) return false;
    }
    const VectorXd push = state.moment_n * turned_slope - energy.slope(free_);
    const double short_mm = load.turned_mm - sheet_.turned_mm(state.at_mm);
    const auto step = held->solve(push, short_mm);
    state.moment_n -= step.lambda;
    const double longest_mm = move(step.u, state);
    if (!(longest_mm < width_mm)) return false;
    if (longest_mm >= enough_mm) {
      const bool serves = longest_mm <= std::min(kNear_widths * width_mm, kFast * before_mm);
      if (!serves) held.reset();
      before_mm = longest_mm;
      continue;
    }
    const double off_mm = (state.at_mm - predicted_mm).colwise().norm().maxCoeff();
    if (off_mm > std::max(kCloseness * moved_mm, 100 * enough_mm)) return false;
    held_ = std::move(held);
    return true;
  }
  return false;
}

// Returns the largest displacement; squares are those to first order.
double BentFollower::move(const VectorXd& displacement, State& state) const {
  Matrix3Xd moved_mm = Matrix3Xd::Zero(3, sheet_.vertices());
  moved_mm.reshaped()(free_) = displacement;
  state.squares_mm2 = sheet_.squares_mm2(state.at_mm, moved_mm);
  state.at_mm += moved_mm;
  return moved_mm.colwise().norm().maxCoeff();
}

std::optional<Compliance> find_compliance(const ElasticSheet& sheet, const Matrix3Xd& folded_mm) {
  assert(folded_mm.cols() == sheet.vertices());
  const std::vector<int> free = coordinates_but(sheet.coordinates(), sheet.supports(folded_mm));
  const MatrixXd bend = sheet.panels_energy(folded_mm).bend(free, free);
  const HeldStiffness held(bend, sheet.turned_slope(folded_mm)(free));
  if (!held.is_positive()) return {};
  const MatrixXd lower = held.lower(sheet.length_slopes(folded_mm)(Eigen::all, free).transpose());
  return Compliance{sheet.turned_mm(folded_mm), sheet.lengths_mm(folded_mm),
                    lower.transpose() * lower,
                    -sheet.saddle_slopes(folded_mm)(Eigen::all, free) * held.upper(lower)};
}

VectorXd softened(const Compliance& compliance, const MatrixXd& n_per_mm,
                  const VectorXd& forces_n) {
  MatrixXd by_forces = n_per_mm * compliance.mm_per_n;
  by_forces.diagonal().array() += 1;
  return by_forces.partialPivLu().solve(forces_n);
}

BentState bend(const Compliance& compliance, const Filling& filling) {
  assert(filling.diagonals() == compliance.lengths_mm.size());
  const MatrixXd& c = compliance.mm_per_n;
  VectorXd lengths_mm = compliance.lengths_mm, forces_n = VectorXd::Zero(lengths_mm.size());
  for (int step = 0; step < kMostStepsOfForces; ++step) {
    const VectorXd off_n = filling.forces_n(lengths_mm) - forces_n;
    if (off_n.norm() <= kForceError * forces_n.norm()) break;
    forces_n += softened(compliance, filling.stiffness_n_per_mm(lengths_mm), off_n);
    lengths_mm = compliance.lengths_mm - c * forces_n;
  }
  return {filling.energy_n_mm(lengths_mm) + forces_n.dot(c * forces_n) / 2, forces_n,
          compliance.saddle_mm_per_n * forces_n};
}

}  // namespace misalign::solver
