#include "solver/design/bent_state.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <optional>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<int> coordinates_but(Index count, const std::vector<int>& held) {
  std::vector<int> free;
  for (int i = 0; i < count; ++i) {
    if (!std::binary_search(held.begin(), held.end(), i)) free.push_back(i);
  }
  return free;
}

// A u + lambda g = r, g . u = c, with A's null vector along which g changes: by A + beta g g^T,
// which is positive where A is so on all u with g . u = 0.
class HeldStiffness {
 public:
  HeldStiffness(const MatrixXd& a, const VectorXd& g) : g_(g) {
    beta_ = a.diagonal().mean() / g.squaredNorm();
    MatrixXd b = a;
    b.selfadjointView<Eigen::Lower>().rankUpdate(g, beta_);
    factors_.compute(b);
    is_positive_ = factors_.info() == Eigen::Success;
    if (is_positive_) lower_g_ = factors_.matrixL().solve(g);
  }
  bool is_positive() const { return is_positive_; }

  // Columns of L^-1 r without what the held sum takes: their products are r^T A^-1 r.
  MatrixXd lower(const MatrixXd& r) const {
    MatrixXd lower = factors_.matrixL().solve(r);
    lower -= lower_g_ * (lower_g_.transpose() * lower) / lower_g_.squaredNorm();
    return lower;
  }
  MatrixXd upper(const MatrixXd& lower) const { return factors_.matrixU().solve(lower); }

  struct Step {
    VectorXd u;
    double lambda;
  };
  Step solve(const VectorXd& r, double c) const {
    const VectorXd lower = factors_.matrixL().solve(r);
    const double mu = (lower_g_.dot(lower) - c) / lower_g_.squaredNorm();
    return {factors_.matrixU().solve(lower - mu * lower_g_), mu + beta_ * c};
  }

 private:
  const VectorXd g_;
  double beta_;
  bool is_positive_;
  Eigen::LLT<MatrixXd> factors_;
  VectorXd lower_g_;
};

}  // namespace

std::optional<Compliance> find_compliance(const ElasticSheet& sheet, const Matrix3Xd& folded_mm) {
  const std::vector<int> free = coordinates_but(sheet.coordinates(), sheet.supports(folded_mm));
  const MatrixXd bend = sheet.panels_energy(folded_mm).bend(free, free);
  const HeldStiffness held(bend, sheet.turned_slope(folded_mm)(free));
  if (!held.is_positive()) return {};
  const MatrixXd lower = held.lower(sheet.length_slopes(folded_mm)(Eigen::all, free).transpose());
  return Compliance{sheet.turned_mm(folded_mm), sheet.lengths_mm(folded_mm),
                    lower.transpose() * lower,
                    -sheet.saddle_slopes(folded_mm)(Eigen::all, free) * held.upper(lower)};
}

BentState bend(const Compliance& compliance, const DiagonalSprings& springs) {
  const VectorXd pull = compliance.lengths_mm - springs.relaxed_mm;
  MatrixXd give = compliance.mm_per_n;
  give.diagonal().array() += 1 / springs.n_per_mm;
  BentState state;
  state.forces_n = give.llt().solve(pull);
  state.n_mm = state.forces_n.dot(pull) / 2;
  state.saddles_mm = compliance.saddle_mm_per_n * state.forces_n;
  return state;
}

FarBentState bend_far(const ElasticSheet& sheet, const Matrix3Xd& start_mm, double turned_mm,
                      const DiagonalSprings& springs, const BendOptions& options) {
  const std::vector<int> free = coordinates_but(sheet.coordinates(), sheet.supports(start_mm));
  const double width = sheet.panel_width_mm();
  FarBentState state;
  state.at_mm = start_mm;
  for (; state.steps < options.most_steps && !state.has_converged; ++state.steps) {
    ElasticEnergy energy = sheet.panels_energy(state.at_mm);
    sheet.add_springs(state.at_mm, springs.n_per_mm, springs.relaxed_mm, energy);
    sheet.add_turned_bend(state.at_mm, -state.moment_n, energy.bend);
    const VectorXd turned_slope = sheet.turned_slope(state.at_mm);
    MatrixXd bend = energy.bend(free, free);
    // Far from a minimum: stiffer, until it is one.
    double shift = 0;
    const double least = 1e-6 * bend.diagonal().mean();
    std::optional<HeldStiffness> held(std::in_place, bend, turned_slope(free));
    while (!held->is_positive() && shift < 1e12 * least) {
      const double next = std::max(least, 4 * shift);
      bend.diagonal().array() += next - shift;
      shift = next;
      held.emplace(bend, turned_slope(free));
    }
    if (!held->is_positive()) return state;
    state.is_stable = shift == 0;
    const auto step = held->solve(-energy.slope(free), turned_mm - sheet.turned_mm(state.at_mm));
    VectorXd moved = VectorXd::Zero(sheet.coordinates());
    for (Index i = 0; i < step.u.size(); ++i) moved(free[static_cast<std::size_t>(i)]) = step.u(i);
    const auto by_vertex = moved.reshaped(3, sheet.vertices());
    const double longest = by_vertex.colwise().norm().maxCoeff();
    if (!(longest < 1e6 * width)) return state;
    const double share = std::min(1.0, options.longest_widths * width / longest);
    state.at_mm += share * by_vertex;
    state.moment_n = -step.lambda;
    state.has_converged = longest < options.step_widths * width && shift == 0;
  }
  ElasticEnergy energy = sheet.panels_energy(state.at_mm);
  sheet.add_springs(state.at_mm, springs.n_per_mm, springs.relaxed_mm, energy);
  state.n_mm = energy.n_mm;
  state.forces_n = springs.n_per_mm * (sheet.lengths_mm(state.at_mm) - springs.relaxed_mm);
  state.saddles_mm = sheet.saddles_mm(state.at_mm);
  return state;
}

}  // namespace misalign::solver
