#include "tests/bench/work_precision/truth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/kinematics/diagonals.hpp"
#include "solver/linear/newton.hpp"
#include "tests/bench/work_precision/quad.hpp"
#include "tests/bench/work_precision/scalar.hpp"

namespace misalign::bench {
namespace {

constexpr double kTruthTolerance = 1e-28;
constexpr int kMaxRefinements = 10;

solver::SheetGeometry<Quad> placed(const solver::Mechanism& mechanism,
                                   const solver::FlatVertices& vertices_mm) {
  solver::SheetGeometry<Quad> geometry;
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    geometry.x.push_back(Quad(vertices_mm(0, v)) / mechanism.panel_width_mm);
    geometry.y.push_back(Quad(vertices_mm(1, v)) / mechanism.panel_width_mm);
  }
  for (const solver::Edge& edge : mechanism.edges) {
    const Quad dx = geometry.x[edge.b] - geometry.x[edge.a];
    const Quad dy = geometry.y[edge.b] - geometry.y[edge.a];
    const Quad length = sqrt(dx * dx + dy * dy);
    geometry.axis_x.push_back(dx / length);
    geometry.axis_y.push_back(dy / length);
  }
  return geometry;
}

void normalize(solver::FoldState<Quad>& state) {
  for (auto& h : state.creases) {
    const Quad length = sqrt(h.c * h.c + h.s * h.s);
    h = {h.c / length, h.s / length};
  }
  for (auto& q : state.balls) q = q.normalized();
}

}  // namespace

Truth::Truth(const Problem& problem) : problem_(problem) {
  const solver::Mechanism& mechanism = problem.mechanism();
  solver::Newton newton(mechanism);
  for (const Sheet& sheet : problem.sheets()) {
    solver::FoldState<double> state = problem.base_state(1);
    for (int degree = 1; degree <= kEnd_deg; ++degree) {
      state.creases[mechanism.pilot] = solver::half_angle_of_deg(degree);
      if (newton.correct(sheet.geometry, state).end != solver::Newton::StopReason::converged) {
        throw std::runtime_error("no solution to refine");
      }
      refine(sheet, state);
    }
  }
}

// Newton with the residual in extended precision and the Jacobian's factors in double: every step
// gains some eleven digits.
void Truth::refine(const Sheet& sheet, const solver::FoldState<double>& near) {
  const solver::Mechanism& mechanism = problem_.mechanism();
  const solver::SheetGeometry<Quad> geometry = placed(mechanism, sheet.vertices_mm);
  solver::ClosureSystem system(mechanism);
  solver::DenseSolve factors(mechanism.equations);
  system.evaluate(sheet.geometry, near);
  factors.factorize(system.jacobian().leftCols(mechanism.equations));

  solver::FoldState<Quad> state = state_as<Quad>(near);
  normalize(state);
  std::vector<Quad> residual(static_cast<std::size_t>(mechanism.equations));
  std::vector<Quad> step(static_cast<std::size_t>(mechanism.unknowns), Quad(0));
  Eigen::VectorXd rhs(mechanism.equations);
  for (int refinement = 0;; ++refinement) {
    const Quad open = solver::evaluate<Quad>(mechanism, geometry, state, residual.data(), nullptr);
    if (open <= kTruthTolerance) {
      open_by_ = std::max(open_by_, static_cast<double>(open));
      break;
    }
    if (refinement == kMaxRefinements) throw std::runtime_error("the truth does not converge");
    for (Eigen::Index i = 0; i < rhs.size(); ++i) {
      rhs[i] = static_cast<double>(residual[static_cast<std::size_t>(i)]);
    }
    const Eigen::VectorXd& x = factors.solve(rhs);
    for (Eigen::Index i = 0; i < rhs.size(); ++i) step[static_cast<std::size_t>(i)] = -x[i];
    solver::advance(mechanism, step.data(), state);
  }
  std::vector<Quad> lengths(mechanism.diagonals.size());
  solver::folded_lengths(mechanism, geometry, state, lengths.data());
  for (const Quad& length : lengths) {
    const double high = static_cast<double>(length);
    lengths_.push_back({high, static_cast<double>(length - high)});
  }
}

double Truth::error_mm(int sheet, int degree, int diagonal, double length) const {
  const int index = (sheet * kEnd_deg + degree - 1) * problem_.diagonals() + diagonal;
  const Length& truth = lengths_[static_cast<std::size_t>(index)];
  const double error = std::abs((length - truth.high) - truth.low);
  return std::isfinite(error) ? error * problem_.mechanism().panel_width_mm : INFINITY;
}

double Truth::largest_error_mm(int sheet, int spacing_deg,
                               const std::vector<double>& lengths) const {
  const int diagonals = problem_.diagonals();
  double largest = 0;
  for (int k = 0; k < static_cast<int>(lengths.size()); ++k) {
    largest = std::max(largest, error_mm(sheet, (k / diagonals + 1) * spacing_deg, k % diagonals,
                                         lengths[static_cast<std::size_t>(k)]));
  }
  return largest;
}

double Truth::last_error_mm(int sheet, const std::vector<double>& lengths) const {
  const int diagonals = problem_.diagonals();
  const double* last = lengths.data() + lengths.size() - diagonals;
  double largest = 0;
  for (int d = 0; d < diagonals; ++d) {
    largest = std::max(largest, error_mm(sheet, kEnd_deg, d, last[d]));
  }
  return largest;
}

}  // namespace misalign::bench
