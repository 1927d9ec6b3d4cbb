#include "solver/motion/joint_forces.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numeric>

#include "solver/linear/newton.hpp"
#include "solver/linear/sparse_rank.hpp"
#include "solver/motion/panel_loads.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kOfCrease = 5, kOfBall = 3;

class Reactions {
 public:
  Reactions(const EnergyModel& sheet, const FoldedShape& shape, const PerforatedSheet& base,
            const JointForces::Options& options)
      : mechanism_(sheet.way().mechanism()), loads_(sheet, shape, base, options.in_motion) {}

  int count() const {
    return kOfCrease * static_cast<int>(mechanism_.creases.size()) +
           kOfBall * static_cast<int>(mechanism_.balls.size());
  }
  int rank() const { return rank_; }

  // Fills the matrices' rows at one angle.
  void find(const Deployment::Row& at, const std::optional<VectorXd>& filling_forces_n, Index row,
            JointForces& forces);

 private:
  Eigen::MatrixXd reactions_matrix() const;
  Eigen::MatrixXd self_stresses() const;
  VectorXd solve(const VectorXd& loads);

  const Mechanism& mechanism_;
  PanelLoads loads_;
  int rank_ = 0;
};

// Effect of each reaction on the panels, six rows a panel; the last column is the moment with which
// the pilot crease holds the sheet.
Eigen::MatrixXd Reactions::reactions_matrix() const {
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(PanelLoads::kOfPanel * loads_.panels(), count() + 1);
  VectorXd column(matrix.rows());
  Index next = 0;
  const auto add = [&](int to, int from, const Vector3d& at_mm, const Vector3d& force,
                       const Vector3d& moment) {
    column.setZero();
    loads_.add(to, at_mm, force, moment, column);
    loads_.add(from, at_mm, -force, -moment, column);
    matrix.col(next++) = column;
  };
  const auto add_moment = [&](int k, const Vector3d& about) {
    const Crease& crease = mechanism_.creases[static_cast<std::size_t>(k)];
    const PanelLoads::Hinge& hinge = loads_.hinges()[static_cast<std::size_t>(k)];
    add(loads_.panel_of(crease.right), loads_.panel_of(crease.left), hinge.middle_mm,
        Vector3d::Zero(), hinge.length_mm * about);
  };
  for (int k = 0; k < static_cast<int>(loads_.hinges().size()); ++k) {
    const Crease& crease = mechanism_.creases[static_cast<std::size_t>(k)];
    const PanelLoads::Hinge& hinge = loads_.hinges()[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i) {
      add(loads_.panel_of(crease.right), loads_.panel_of(crease.left), hinge.middle_mm,
          Vector3d::Unit(i), Vector3d::Zero());
    }
    add_moment(k, hinge.one);
    add_moment(k, hinge.other);
  }
  for (const BallJoint& ball : mechanism_.balls) {
    const int to = loads_.panel_of(ball.to_facet), from = loads_.panel_of(ball.from_facet);
    const Vector3d at_mm = loads_.place_mm(to, ball.vertex);
    for (int i = 0; i < 3; ++i) add(to, from, at_mm, Vector3d::Unit(i), Vector3d::Zero());
  }
  add_moment(mechanism_.pilot, loads_.hinges()[static_cast<std::size_t>(mechanism_.pilot)].axis);
  assert(next == matrix.cols());
  return matrix;
}

// A force that the panels round a whole vertex pass on from one to the next balances. Rows are the
// creases' reactions: three for each such vertex, a force along each axis.
Eigen::MatrixXd Reactions::self_stresses() const {
  std::vector<const Loop*> whole;
  for (const Loop& loop : mechanism_.loops) {
    if (loop.hole < 0) whole.push_back(&loop);
  }
  Eigen::MatrixXd stresses =
      Eigen::MatrixXd::Zero(3 * static_cast<Index>(whole.size()), count() + 1);
  for (std::size_t w = 0; w < whole.size(); ++w) {
    for (const Passage& passage : whole[w]->passages) {
      assert(!passage.ball && "round a whole vertex there are creases alone");
      const auto crease = static_cast<std::size_t>(passage.joint);
      const PanelLoads::Hinge& hinge = loads_.hinges()[crease];
      const int left = loads_.panel_of(mechanism_.creases[crease].left);
      const Vector3d arm_mm = loads_.place_mm(left, passage.vertex) - hinge.middle_mm;
      for (int i = 0; i < 3; ++i) {
        const Vector3d force = passage.sense * Vector3d::Unit(i);
        const Vector3d moment = arm_mm.cross(force) / hinge.length_mm;
        const Index row = 3 * static_cast<Index>(w) + i, first = kOfCrease * passage.joint;
        stresses.block<1, 3>(row, first) = force.transpose();
        stresses(row, first + 3) = moment.dot(hinge.one);
        stresses(row, first + 4) = moment.dot(hinge.other);
      }
    }
  }
  return stresses;
}

// Solves the balance of all panels but one, which follows from the others (the support balances the
// held one), with no component of any self-stress: as many equations as unknowns.
VectorXd Reactions::solve(const VectorXd& loads) {
  assert(loads.size() == PanelLoads::kOfPanel * loads_.panels());
  const Eigen::MatrixXd matrix = reactions_matrix(), stresses = self_stresses();
  const Index panels = matrix.rows() - PanelLoads::kOfPanel,
              first = PanelLoads::kOfPanel * loads_.held().value_or(0);
  Eigen::MatrixXd square(panels + stresses.rows(), matrix.cols());
  VectorXd wanted = VectorXd::Zero(square.rows());
  square << matrix.topRows(first), matrix.bottomRows(panels - first), stresses;
  wanted.head(panels) << -loads.head(first), -loads.tail(panels - first);
  assert(square.rows() == square.cols());
  // Moments of the panels' balance over a panel's width.
  for (Index row = 3; row < panels; row += PanelLoads::kOfPanel) {
    square.middleRows<3>(row) /= mechanism_.panel_width_mm;
    wanted.segment<3>(row) /= mechanism_.panel_width_mm;
  }
  if (rank_ == 0) {
    const Eigen::SparseMatrix<double> of_reactions =
        square.topLeftCorner(panels, count()).sparseView();
    std::vector<int> order(static_cast<std::size_t>(count()));
    std::iota(order.begin(), order.end(), 0);
    constexpr double kLeast = 1e-9;  // those of Table 1 are above 1e-4 from 1 degree on
    rank_ = sparse_rank(of_reactions, order, kLeast);
  }
  DenseSolve factors(square.rows());
  factors.factorize(square);
  return factors.solve(wanted);
}

void Reactions::find(const Deployment::Row& at, const std::optional<VectorXd>& filling_forces_n,
                     Index row, JointForces& forces) {
  loads_.pose(at);
  const VectorXd reactions = solve(loads_.find(filling_forces_n));

  const Vector3d seen(1, 1,
                      mechanism_.side);  // a mirror keeps forces and reverses moments
  Index next = 0;
  for (Index k = 0; k < static_cast<Index>(loads_.hinges().size()); ++k, next += kOfCrease) {
    const PanelLoads::Hinge& hinge = loads_.hinges()[static_cast<std::size_t>(k)];
    const Vector3d moment =
        hinge.length_mm * (reactions(next + 3) * hinge.one + reactions(next + 4) * hinge.other);
    forces.crease_force_n.block<1, 3>(row, 3 * k) =
        reactions.segment<3>(next).cwiseProduct(seen).transpose();
    forces.crease_moment_n_mm.block<1, 3>(row, 3 * k) =
        (mechanism_.side * moment.cwiseProduct(seen)).transpose();
    forces.crease_axis.block<1, 3>(row, 3 * k) = hinge.axis.cwiseProduct(seen).transpose();
  }
  const std::size_t pilot = static_cast<std::size_t>(mechanism_.pilot);
  forces.holding_n_mm.push_back(loads_.hinges()[pilot].length_mm * reactions(reactions.size() - 1));
  for (Index k = 0; k < static_cast<Index>(mechanism_.balls.size()); ++k, next += kOfBall) {
    forces.ball_force_n.block<1, 3>(row, 3 * k) =
        reactions.segment<3>(next).cwiseProduct(seen).transpose();
  }
}

}  // namespace

JointForces find_joint_forces(const EnergyModel& sheet, const FoldedShape& shape,
                              const PerforatedSheet& base, const Deployment& deployment,
                              const JointForces::Options& options) {
  const Mechanism& mechanism = sheet.way().mechanism();
  assert(options.filling_forces_n.empty() ||
         options.filling_forces_n.size() == deployment.rows.size());
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < deployment.rows.size(); ++k) {
    if (std::abs(deployment.rows[k].pilot_deg) >= options.from_deg) rows.push_back(k);
  }
  const auto count = static_cast<Index>(rows.size());
  const auto creases = static_cast<Index>(mechanism.creases.size());
  Reactions reactions(sheet, shape, base, options);
  JointForces forces;
  forces.crease_force_n.resize(count, 3 * creases);
  forces.crease_moment_n_mm.resize(count, 3 * creases);
  forces.crease_axis.resize(count, 3 * creases);
  forces.ball_force_n.resize(count, 3 * static_cast<Index>(mechanism.balls.size()));
  for (Index k = 0; k < count; ++k) {
    const std::size_t at = rows[static_cast<std::size_t>(k)];
    forces.pilot_deg.push_back(deployment.rows[at].pilot_deg);
    reactions.find(deployment.rows[at],
                   options.filling_forces_n.empty() ? std::nullopt
                                                    : std::optional(options.filling_forces_n[at]),
                   k, forces);
  }
  forces.crease_shared.assign(mechanism.creases.size(), false);
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole >= 0) continue;
    for (const Passage& passage : loop.passages) {
      if (!passage.ball) forces.crease_shared[static_cast<std::size_t>(passage.joint)] = true;
    }
  }
  forces.reactions = reactions.count();
  forces.rank = reactions.rank();
  assert(forces.rank <= forces.reactions);
  return forces;
}

}  // namespace misalign::solver
