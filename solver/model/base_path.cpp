#include "solver/model/base_path.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cassert>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/loop_closure.hpp"
#include "solver/linear/singular_value.hpp"

namespace misalign::solver {
namespace {

// Pilot angle at which the proportions are read.
constexpr double kUnitPilot_deg = 90;

Eigen::Vector3d axis_across(const PerforatedSheet& base, const BallJoint::Crossing& crossing) {
  const Edge& edge = base.sheet.edges[static_cast<std::size_t>(crossing.edge)];
  const FlatVertices& at = base.sheet.vertices_mm;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  axis.head<2>() = -crossing.sense * (at.col(edge.b) - at.col(edge.a)).normalized();
  return axis;
}

}  // namespace

// J without the pilot's column, and the Cholesky factor of its normal matrix, with the same
// singular values up to what squaring loses.
struct BasePath::Equations {
  explicit Equations(const Mechanism& mechanism)
      : entries(jacobian_entries(mechanism)),
        values(entries.size()),
        residual(static_cast<std::size_t>(mechanism.equations)),
        misfit(residual),
        jacobian(mechanism.equations, mechanism.unknowns - 1),
        smallest(mechanism.unknowns - 1) {}

  void factorize() {
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      if (entries[k].column == jacobian.cols()) continue;
      triplets.emplace_back(entries[k].row, entries[k].column, values[k]);
    }
    jacobian.setFromTriplets(triplets.begin(), triplets.end());
    factor.compute(Eigen::SparseMatrix<double>(jacobian.transpose() * jacobian));
  }
  // Factors for SmallestSingularValue: the upper triangle and its transpose.
  void solve(const double* rhs, double* x) const { take(factor.matrixU(), rhs, x); }
  void solve_transposed(const double* rhs, double* x) const { take(factor.matrixL(), rhs, x); }
  template <class Triangle>
  void take(const Triangle& triangle, const double* rhs, double* x) const {
    Eigen::VectorXd::Map(x, jacobian.cols()) =
        triangle.solve(Eigen::VectorXd::Map(rhs, jacobian.cols()));
  }

  const std::vector<JacobianEntry> entries;
  std::vector<double> values, residual, misfit;
  Eigen::SparseMatrix<double> jacobian;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor;
  SmallestSingularValue<double> smallest;
};

BasePath::BasePath(const Mechanism& mechanism, const PerforatedSheet& base)
    : mechanism_(mechanism), base_(base), equations_(std::make_unique<Equations>(mechanism)) {
  assert(base.folding.end_deg() > kUnitPilot_deg);
  for (const HalfAngle<double>& rho : base.folding.fold_angles(half_angle_of_deg(kUnitPilot_deg))) {
    tangents_.push_back(rho.s / rho.c);
  }
}

BasePath::~BasePath() = default;

void BasePath::find_state(const HalfAngle<double>& pilot, FoldState<double>& state) const {
  state = base_state(mechanism_, base_.folding, base_.sheet.vertices_mm, pilot);
}

// tan(rho / 2) = r tan(pilot / 2), so that the fold angle's rate is r / (c^2 + r^2 s^2) of the
// pilot's. A ball joint turns like the base's two creases across it, one after the other.
void BasePath::find_rates(const HalfAngle<double>& pilot, std::vector<double>& rates) const {
  const auto rate_of = [&](int edge) {
    const double r = tangents_[static_cast<std::size_t>(edge)];
    return r / (pilot.c * pilot.c + r * r * pilot.s * pilot.s);
  };
  rates.resize(static_cast<std::size_t>(mechanism_.unknowns));
  for (const Crease& crease : mechanism_.creases) {
    rates[static_cast<std::size_t>(crease.column)] = rate_of(crease.edge);
  }
  for (const BallJoint& ball : mechanism_.balls) {
    const auto& [first, second] = ball.through;
    const double r = tangents_[static_cast<std::size_t>(first.edge)];
    const Eigen::Vector3d axis = axis_across(base_, first);
    const HalfAngle<double> half = half_angle_of_ratio(r * pilot.s, pilot.c);
    const Eigen::Quaterniond turned(half.c, half.s * axis.x(), half.s * axis.y(), 0);
    const Eigen::Vector3d turn =
        rate_of(first.edge) * axis + rate_of(second.edge) * (turned * axis_across(base_, second));
    Eigen::Vector3d::Map(rates.data() + ball.column) = turn;
  }
}

void BasePath::find(const SheetGeometry<double>& geometry, const HalfAngle<double>& pilot,
                    PathPoint& point) const {
  find_state(pilot, point.state);
  find_rates(pilot, point.rates);
  const auto rates = Eigen::VectorXd::Map(point.rates.data(), std::ssize(point.rates));
  point.pilot_rate = 1 / rates.norm();
  std::vector<double>& misfit = equations_->misfit;
  folded_lengths_and_slopes(mechanism_, geometry, point.state, point.rates.data(),
                            point.lengths.data(), point.slopes.data(), misfit.data());
  point.misfit = Eigen::VectorXd::Map(misfit.data(), std::ssize(misfit)).cwiseAbs().maxCoeff();
}

double BasePath::open_by(const SheetGeometry<double>& geometry, const FoldState<double>& state) {
  return evaluate(mechanism_, geometry, state, equations_->residual.data(),
                  equations_->values.data());
}

double BasePath::singular_value() {
  equations_->factorize();
  if (equations_->factor.info() != Eigen::Success) return 0;
  return equations_->smallest.of(*equations_);
}

}  // namespace misalign::solver
