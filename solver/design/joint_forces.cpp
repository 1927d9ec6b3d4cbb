#include "solver/design/joint_forces.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kOfCrease = 5, kOfBall = 3, kOfPanel = 6;

// Velocities and angular momenta of the panels along the way, from which accelerations follow.
SmoothTable momenta_on_the_way(const FoldingWay& way, SheetMover& mover) {
  const auto count = static_cast<Index>(way.stations().size());
  Eigen::MatrixXd values;
  for (Index k = 0; k < count; ++k) {
    const WayStation& station = way.stations()[static_cast<std::size_t>(k)];
    const MovingSheet sheet = mover.move(station.state, station.rates.data());
    if (k == 0) values.resize(kOfPanel * static_cast<Index>(sheet.panels.size()), count);
    Index row = 0;
    for (const MovingPanel& panel : sheet.panels) {
      values.block<3, 1>(row, k) = panel.velocity;
      values.block<3, 1>(row + 3, k) = panel.inertia * panel.spin;
      row += kOfPanel;
    }
  }
  // Of the mirror image, run through in the other direction.
  using enum SmoothTable::Parity;
  std::vector<SmoothTable::Parity> parities;
  for (Index row = 0; row < values.rows(); row += kOfPanel) {
    parities.insert(parities.end(), {odd, odd, even, even, even, odd});
  }
  return way.table(values, std::move(parities));
}

class Balance {
 public:
  Balance(const DeployingSheet& sheet, const FoldedShape& shape, const PerforatedSheet& base,
          const JointForcesOptions& options)
      : sheet_(sheet),
        way_(sheet.way()),
        mechanism_(way_.mechanism()),
        options_(options),
        panels_(panels_of(base, mechanism_)),
        masses_(panel_masses(sheet.options().plates, panels_.corners, way_.vertices_mm())),
        held_(sheet.options().held ? std::optional(sheet.options().held->panel) : std::nullopt),
        mover_(shape, way_, panels_, masses_, held_),
        momenta_(momenta_on_the_way(way_, mover_)),
        panel_of_facet_(base.sheet.facets.size(), -1),
        panels_at_(base.sheet.facets.empty() ? 0 : static_cast<std::size_t>(mechanism_.vertices)) {
    for (std::size_t k = 0; k < panels_.facets.size(); ++k) {
      panel_of_facet_[static_cast<std::size_t>(panels_.facets[k])] = static_cast<int>(k);
      for (const int v : panels_.corners[k]) {
        panels_at_[static_cast<std::size_t>(v)].push_back(static_cast<int>(k));
      }
    }
  }

  int reactions() const {
    return kOfCrease * static_cast<int>(mechanism_.creases.size()) +
           kOfBall * static_cast<int>(mechanism_.balls.size());
  }
  int rank() const { return rank_; }
  double unbalanced_n() const { return unbalanced_n_; }

  // The reactions at a row: matrices' rows are filled in.
  void find(const DeploymentRow& at, Index row, JointForces& forces);

 private:
  struct Moved {
    double rate, acceleration;  // of x
  };

  Moved moved(const DeploymentRow& at) const {
    if (!options_.in_motion) return {0, 0};
    const SheetAt here = sheet_.at(at.x);
    const double friction = at.x_rate == 0 ? 0 : std::copysign(here.friction, at.x_rate);
    const double force = -here.mass_slope * at.x_rate * at.x_rate / 2 - here.slope - friction -
                         here.damping * at.x_rate;
    return {at.x_rate, force / here.mass};
  }
  int panel_of(int facet) const { return panel_of_facet_[static_cast<std::size_t>(facet)]; }
  Vector3d flat_direction(const Crease& crease) const {
    const Eigen::Vector2d along =
        way_.vertices_mm().col(crease.b) - way_.vertices_mm().col(crease.a);
    return {along.x(), along.y(), 0};
  }
  // Adds a force at a place, and a moment, to a panel's six.
  void load(int panel, const Vector3d& at_mm, const Vector3d& force_n, const Vector3d& moment,
            VectorXd& loads) const {
    const Index first = kOfPanel * panel;
    const Vector3d arm = at_mm - panels_here_.panels[static_cast<std::size_t>(panel)].centre_mm;
    loads.segment<3>(first) += force_n;
    loads.segment<3>(first + 3) += arm.cross(force_n) + moment;
  }
  void load_by_inertia(double x, const Moved& moved, VectorXd& loads);
  void load_by_springs(double x, VectorXd& loads);
  void load_by_joints(double x, const Moved& moved, VectorXd& loads);
  void load_by_weight(VectorXd& loads) const;
  Eigen::MatrixXd reactions_matrix();

  const DeployingSheet& sheet_;
  const FoldingWay& way_;
  const Mechanism& mechanism_;
  const JointForcesOptions& options_;
  const Panels panels_;
  const std::vector<PanelMass> masses_;
  const std::optional<int> held_;
  SheetMover mover_;
  const SmoothTable momenta_;
  std::vector<int> panel_of_facet_;
  std::vector<std::vector<int>> panels_at_;  // each vertex
  MovingSheet panels_here_{};
  struct Hinge {
    Vector3d middle_mm, axis, one, other;  // axis from a to b, and two directions square to it
    double length_mm;
  };
  std::vector<Hinge> hinges_;
  int rank_ = 0;
  double unbalanced_n_ = 0;
};

// m a = F and dH/dt = M, the frame of the first panel turning itself.
void Balance::load_by_inertia(double x, const Moved& moved, VectorXd& loads) {
  VectorXd momenta, slopes;
  momenta_.find(x, 0, momenta_.functions(), momenta, slopes);
  const Vector3d frame_spin = panels_here_.frame_spin * moved.rate;
  for (std::size_t k = 0; k < masses_.size(); ++k) {
    const Index first = kOfPanel * static_cast<Index>(k);
    const auto rate_of = [&](Index at) -> Vector3d {
      const Vector3d here = momenta.segment<3>(at), slope = slopes.segment<3>(at);
      return slope * moved.rate * moved.rate + here * moved.acceleration +
             frame_spin.cross(here * moved.rate);
    };
    loads.segment<3>(first) -= masses_[k].mass_t * rate_of(first);
    loads.segment<3>(first + 3) -= rate_of(first + 3);
  }
}

// A spring's force is taken in equal parts by the panels that meet at the corner.
void Balance::load_by_springs(double x, VectorXd& loads) {
  const VectorXd forces_n = sheet_.spring_forces_n(x);
  const auto corner_mm = [&](int panel, int vertex) {
    return mover_.place_mm(panel, way_.vertices_mm().col(vertex));
  };
  for (int d = 0; d < mechanism_.diagonal_count(); ++d) {
    const Diagonal& diagonal = mechanism_.diagonals[static_cast<std::size_t>(d)];
    const auto& at_from = panels_at_[static_cast<std::size_t>(diagonal.from)];
    const auto& at_to = panels_at_[static_cast<std::size_t>(diagonal.to)];
    const Vector3d from_mm = corner_mm(at_from.front(), diagonal.from),
                   to_mm = corner_mm(at_to.front(), diagonal.to);
    const Vector3d pull_n = forces_n(d) * (to_mm - from_mm).normalized();
    for (const int panel : at_from) {
      load(panel, from_mm, pull_n / static_cast<double>(at_from.size()), Vector3d::Zero(), loads);
    }
    for (const int panel : at_to) {
      load(panel, to_mm, -pull_n / static_cast<double>(at_to.size()), Vector3d::Zero(), loads);
    }
  }
}

// About creases: the right panel turns by -rho about a -> b, so what resists rho pushes it on.
void Balance::load_by_joints(double x, const Moved& moved, VectorXd& loads) {
  const VectorXd resisting = sheet_.crease_moments_n_mm(x, moved.rate);
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    const Crease& crease = mechanism_.creases[k];
    double moment = resisting(static_cast<Index>(k));
    if (!options_.in_motion && static_cast<int>(k) == mechanism_.pilot) {
      moment -= sheet_.at(x).slope / way_.pilot_rate(x);  // holds the sheet
    }
    load(panel_of(crease.right), hinges_[k].middle_mm, Vector3d::Zero(), moment * hinges_[k].axis,
         loads);
    load(panel_of(crease.left), hinges_[k].middle_mm, Vector3d::Zero(), -moment * hinges_[k].axis,
         loads);
  }
  const double ball_n_mm = sheet_.options().joints.ball_friction_n_mm;
  if (ball_n_mm <= 0 || moved.rate == 0) return;
  for (const BallJoint& ball : mechanism_.balls) {
    const auto spin_of = [&](int facet) {
      return panels_here_.panels[static_cast<std::size_t>(panel_of(facet))].spin;
    };
    const Vector3d turning = moved.rate * (spin_of(ball.to_facet) - spin_of(ball.from_facet));
    const Vector3d moment = -ball_n_mm * turning.normalized();
    loads.segment<3>(kOfPanel * panel_of(ball.to_facet) + 3) += moment;
    loads.segment<3>(kOfPanel * panel_of(ball.from_facet) + 3) -= moment;
  }
}

void Balance::load_by_weight(VectorXd& loads) const {
  if (!held_) return;
  Vector3d gravity = sheet_.options().held->gravity_mm_per_s2;
  gravity.z() *= mechanism_.side;
  gravity = mover_.turn(*held_) * gravity;
  for (std::size_t k = 0; k < masses_.size(); ++k) {
    loads.segment<3>(kOfPanel * static_cast<Index>(k)) += masses_[k].mass_t * gravity;
  }
}

// Six rows a panel: what each reaction does to it. Moments are counted over the crease's length,
// so that all unknowns are forces.
Eigen::MatrixXd Balance::reactions_matrix() {
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(kOfPanel * static_cast<Index>(masses_.size()), reactions());
  VectorXd column(matrix.rows());
  Index next = 0;
  const auto add = [&](int to, int from, const Vector3d& at_mm, const Vector3d& force,
                       const Vector3d& moment) {
    column.setZero();
    load(to, at_mm, force, moment, column);
    load(from, at_mm, -force, -moment, column);
    matrix.col(next++) = column;
  };
  for (std::size_t k = 0; k < hinges_.size(); ++k) {
    const int right = panel_of(mechanism_.creases[k].right),
              left = panel_of(mechanism_.creases[k].left);
    const Hinge& hinge = hinges_[k];
    for (int i = 0; i < 3; ++i) {
      add(right, left, hinge.middle_mm, Vector3d::Unit(i), Vector3d::Zero());
    }
    for (const Vector3d& about : {hinge.one, hinge.other}) {
      add(right, left, hinge.middle_mm, Vector3d::Zero(), hinge.length_mm * about);
    }
  }
  for (const BallJoint& ball : mechanism_.balls) {
    const int to = panel_of(ball.to_facet), from = panel_of(ball.from_facet);
    const Vector3d at_mm = mover_.place_mm(to, way_.vertices_mm().col(ball.vertex));
    for (int i = 0; i < 3; ++i) add(to, from, at_mm, Vector3d::Unit(i), Vector3d::Zero());
  }
  return matrix;
}

void Balance::find(const DeploymentRow& at, Index row, JointForces& forces) {
  FoldState<double> state = way_.stations().front().state;
  way_.find_state(at.x, state);
  VectorXd rates;
  way_.find_rates(at.x, rates);
  panels_here_ = mover_.move(state, rates.data());
  hinges_.clear();
  for (const Crease& crease : mechanism_.creases) {
    const int left = panel_of(crease.left);
    const Vector3d axis = (mover_.turn(left) * flat_direction(crease)).normalized();
    const Eigen::Vector2d middle =
        (way_.vertices_mm().col(crease.a) + way_.vertices_mm().col(crease.b)) / 2;
    const Vector3d one = axis.unitOrthogonal();
    hinges_.push_back(
        {mover_.place_mm(left, middle), axis, one, axis.cross(one), flat_direction(crease).norm()});
  }
  const Moved moved = this->moved(at);
  VectorXd loads = VectorXd::Zero(kOfPanel * static_cast<Index>(masses_.size()));
  load_by_springs(at.x, loads);
  load_by_joints(at.x, moved, loads);
  load_by_weight(loads);
  if (options_.in_motion) load_by_inertia(at.x, moved, loads);

  Eigen::MatrixXd matrix = reactions_matrix();
  // Moments of the panels' balance over a panel's width; what holds a held panel is not asked.
  const double width_mm = mechanism_.panel_width_mm;
  for (Index first = 3; first < matrix.rows(); first += kOfPanel) {
    matrix.middleRows<3>(first) /= width_mm;
    loads.segment<3>(first) /= width_mm;
  }
  if (held_) {
    matrix.middleRows<kOfPanel>(kOfPanel * *held_).setZero();
    loads.segment<kOfPanel>(kOfPanel * *held_).setZero();
  }
  constexpr double kRankThreshold = 1e-9;  // singular values of determinate modes are above 1e-4
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors(matrix.rows(), matrix.cols());
  factors.setThreshold(kRankThreshold);
  factors.compute(matrix);
  const VectorXd found = factors.solve(-loads);
  rank_ = static_cast<int>(factors.rank());
  unbalanced_n_ = std::max(unbalanced_n_, (matrix * found + loads).cwiseAbs().maxCoeff());

  Vector3d seen(1, 1, mechanism_.side);  // forces are seen in the mirror, moments turn round there
  Index next = 0;
  for (Index k = 0; k < static_cast<Index>(hinges_.size()); ++k, next += kOfCrease) {
    const Hinge& hinge = hinges_[static_cast<std::size_t>(k)];
    const Vector3d moment =
        hinge.length_mm * (found(next + 3) * hinge.one + found(next + 4) * hinge.other);
    forces.crease_force_n.block<1, 3>(row, 3 * k) =
        found.segment<3>(next).cwiseProduct(seen).transpose();
    forces.crease_moment_n_mm.block<1, 3>(row, 3 * k) =
        (mechanism_.side * moment.cwiseProduct(seen)).transpose();
  }
  for (Index k = 0; k < static_cast<Index>(mechanism_.balls.size()); ++k, next += kOfBall) {
    forces.ball_force_n.block<1, 3>(row, 3 * k) =
        found.segment<3>(next).cwiseProduct(seen).transpose();
  }
}

}  // namespace

JointForces find_joint_forces(const DeployingSheet& sheet, const FoldedShape& shape,
                              const PerforatedSheet& base, const Deployment& deployment,
                              const JointForcesOptions& options) {
  const Mechanism& mechanism = sheet.way().mechanism();
  std::vector<const DeploymentRow*> rows;
  for (const DeploymentRow& row : deployment.rows) {
    if (std::abs(row.pilot_deg) >= options.from_deg) rows.push_back(&row);
  }
  const auto count = static_cast<Index>(rows.size());
  const auto creases = static_cast<Index>(mechanism.creases.size());
  Balance balance(sheet, shape, base, options);
  JointForces forces;
  forces.crease_force_n.resize(count, 3 * creases);
  forces.crease_moment_n_mm.resize(count, 3 * creases);
  forces.ball_force_n.resize(count, 3 * static_cast<Index>(mechanism.balls.size()));
  for (Index k = 0; k < count; ++k) {
    const DeploymentRow& row = *rows[static_cast<std::size_t>(k)];
    forces.pilot_deg.push_back(row.pilot_deg);
    balance.find(row, k, forces);
  }
  forces.crease_shared.assign(mechanism.creases.size(), false);
  for (const Loop& loop : mechanism.loops) {
    if (loop.hole >= 0) continue;
    for (const Passage& passage : loop.passages) {
      if (!passage.ball) forces.crease_shared[static_cast<std::size_t>(passage.joint)] = true;
    }
  }
  forces.reactions = balance.reactions();
  forces.rank = balance.rank();
  forces.unbalanced_n = balance.unbalanced_n();
  return forces;
}

}  // namespace misalign::solver
