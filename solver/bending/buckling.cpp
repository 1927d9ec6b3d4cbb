#include "solver/bending/buckling.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/motion/filling_forces.hpp"
#include "solver/motion/joint_forces.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

Matrix3d axes_of(const Vector3d& along, const Vector3d& other) {
  Matrix3d axes;
  axes.col(0) = along.normalized();
  axes.col(2) = along.cross(other).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// The rotation that lays a folded panel on the flat sheet.
Matrix3d flattening(const FlatVertices& flat_mm, const Matrix3Xd& folded_mm,
                    const std::array<int, 4>& c) {
  const auto flat = [&](int to) -> Vector3d {
    const Vector2d along = flat_mm.col(to) - flat_mm.col(c[0]);
    return {along.x(), along.y(), 0};
  };
  return axes_of(flat(c[1]), flat(c[3])) * axes_of(folded_mm.col(c[1]) - folded_mm.col(c[0]),
                                                   folded_mm.col(c[3]) - folded_mm.col(c[0]))
                                               .transpose();
}

int edge_between(const std::array<int, 4>& corners, int a, int b) {
  for (int i = 0; i < 4; ++i) {
    if (std::minmax(corners[i], corners[(i + 1) % 4]) == std::minmax(a, b)) return i;
  }
  assert(false && "the panel has this edge");
  return 0;
}

// Sums up the forces on each panel.
class Forces {
 public:
  Forces(const Sheet& sheet, const Matrix3Xd& folded_mm)
      : mechanism_(sheet.mechanism()), panels_(sheet.panels()), folded_mm_(folded_mm) {
    for (const auto& corners : panels_.corners) {
      flattened_.push_back(flattening(sheet.vertices_mm(), folded_mm, corners));
    }
    forces_.resize(panels_.corners.size());
  }
  void add_joints(const JointForces& joints, Index row) {
    const auto vector_of = [row](const Eigen::MatrixXd& rows, std::size_t joint) -> Vector3d {
      return rows.block<1, 3>(row, 3 * static_cast<Index>(joint)).transpose();
    };
    for (std::size_t c = 0; c < mechanism_.creases.size(); ++c) {
      const Crease& crease = mechanism_.creases[c];
      const Vector3d force_n = vector_of(joints.crease_force_n, c),
                     moment_n_mm = vector_of(joints.crease_moment_n_mm, c);
      on_edge(panel_of(crease.right), crease.a, crease.b, force_n, moment_n_mm);
      on_edge(panel_of(crease.left), crease.a, crease.b, -force_n, -moment_n_mm);
    }
    for (std::size_t b = 0; b < mechanism_.balls.size(); ++b) {
      const BallJoint& ball = mechanism_.balls[b];
      const Vector3d force_n = vector_of(joints.ball_force_n, b);
      at_corner(panel_of(ball.to_facet), ball.vertex, force_n);
      at_corner(panel_of(ball.from_facet), ball.vertex, -force_n);
    }
  }
  // The forces of the rigid sheet's filling, but along the diagonals these.
  void add_filling(const Filling& filling, const VectorXd& lengths_mm, const VectorXd& forces_n) {
    const FillingForces pushes(mechanism_, panels_);
    for (Index h = 0; h < filling.holes(); ++h) {
      HoleEnergy hole = filling.hole(h, lengths_mm.segment<2>(2 * h));
      hole.force_n = forces_n.segment<2>(2 * h);
      for (const FillingForce& force : pushes.of_hole(filling, h, hole, folded_mm_)) {
        const auto panel = static_cast<std::size_t>(force.panel);
        if (force.from == force.to) {
          at_corner(panel, force.from, force.n);
        } else {
          on_edge(panel, force.from, force.to, force.n, Vector3d::Zero());
        }
      }
    }
  }
  std::vector<PlaneForces> take() { return std::move(forces_); }

 private:
  std::size_t panel_of(int facet) const {
    return static_cast<std::size_t>(panels_.panel_of(facet));
  }
  void at_corner(std::size_t panel, int vertex, const Vector3d& force_n) {
    const auto& corners = panels_.corners[panel];
    const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    assert(at < 4);
    forces_[panel].corner_n[static_cast<std::size_t>(at)] +=
        (flattened_[panel] * force_n).head<2>();
  }
  void on_edge(std::size_t panel, int a, int b, const Vector3d& force_n,
               const Vector3d& moment_n_mm) {
    const auto edge = static_cast<std::size_t>(edge_between(panels_.corners[panel], a, b));
    forces_[panel].edge_n[edge] += (flattened_[panel] * force_n).head<2>();
    forces_[panel].edge_n_mm[edge] += (flattened_[panel] * moment_n_mm).z();
  }

  const Mechanism& mechanism_;
  const Panels& panels_;
  const Matrix3Xd& folded_mm_;
  std::vector<Matrix3d> flattened_;
  std::vector<PlaneForces> forces_;
};

}  // namespace

double BucklingPanel::area_mm2() const {
  return cross(corners_mm[2] - corners_mm[0], corners_mm[3] - corners_mm[1]) / 2;
}

Matrix2d BucklingPanel::mean_force_n_per_mm(const PlaneForces& forces) const {
  Matrix2d sum = Matrix2d::Zero();
  const Vector2d middle_mm = (corners_mm[0] + corners_mm[1] + corners_mm[2] + corners_mm[3]) / 4;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d &from_mm = corners_mm[i], &to_mm = corners_mm[(i + 1) % 4];
    const Vector2d along = (to_mm - from_mm).normalized(), across(-along.y(), along.x());
    sum += forces.corner_n[i] * (from_mm - middle_mm).transpose() +
           forces.edge_n[i] * ((from_mm + to_mm) / 2 - middle_mm).transpose() +
           forces.edge_n_mm[i] * across * along.transpose();
  }
  return (sum + sum.transpose()) / (2 * area_mm2());
}

BucklingFactor buckling_factor(const BucklingPanel& panel, const PlaneForces& forces) {
  const double area_mm2 = panel.area_mm2();
  assert(area_mm2 > 0 && panel.rigidity_n_mm > 0);
  BucklingFactor least{std::numeric_limits<double>::infinity()};
  const Eigen::SelfAdjointEigenSolver<Matrix2d> mean(panel.mean_force_n_per_mm(forces),
                                                     Eigen::EigenvaluesOnly);
  const double pressed_n_per_mm = -mean.eigenvalues()(0);
  if (pressed_n_per_mm > 0) {
    const double longest_mm2 = std::max((panel.corners_mm[2] - panel.corners_mm[0]).squaredNorm(),
                                        (panel.corners_mm[3] - panel.corners_mm[1]).squaredNorm());
    least = {kMeanStress * kPi * kPi * panel.rigidity_n_mm / longest_mm2 / pressed_n_per_mm,
             BucklingKind::mean_stress};
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (panel.is_crease[i] || panel.is_crease[(i + 3) % 4]) continue;
    const Vector2d diagonal_mm = panel.corners_mm[(i + 2) % 4] - panel.corners_mm[i];
    const double pressed_n = forces.corner_n[i].dot(diagonal_mm.normalized());
    if (pressed_n <= 0) continue;
    const double factor = kCornerShare * (1 - panel.poisson) * panel.rigidity_n_mm *
                          diagonal_mm.norm() / (area_mm2 * pressed_n);
    if (factor < least.factor) least = {factor, BucklingKind::corner, static_cast<int>(i)};
  }
  return least;
}

std::vector<BucklingPanel> buckling_panels(const Sheet& sheet, const PanelMaterial& material,
                                           double thickness_mm) {
  const double nu = material.poisson,
               rigidity_n_mm = material.e_mpa() * std::pow(thickness_mm, 3) / 12 / (1 - nu * nu);
  std::vector<BucklingPanel> panels;
  for (const auto& corners : sheet.panels().corners) {
    BucklingPanel panel{{}, {}, rigidity_n_mm, nu};
    for (std::size_t i = 0; i < 4; ++i) panel.corners_mm[i] = sheet.point_mm(corners[i]);
    panels.push_back(panel);
  }
  const Panels& all = sheet.panels();
  for (const FoldLine& fold : all.folds) {
    for (const int k : {fold.left, fold.right}) {
      const auto panel = static_cast<std::size_t>(k);
      const int edge = edge_between(all.corners[panel], fold.a, fold.b);
      panels[panel].is_crease[static_cast<std::size_t>(edge)] = true;
    }
  }
  return panels;
}

std::vector<std::vector<PlaneForces>> plane_forces(const Sheet& sheet, const EnergyModel& rigid,
                                                   const std::vector<double>& pilot_deg,
                                                   const std::vector<VectorXd>& filling_forces_n) {
  assert(pilot_deg.size() == filling_forces_n.size() && sheet.base().springs.at_vertices());
  Deployment held{};
  for (const double angle_deg : pilot_deg) {
    Deployment::Row row{};
    row.pilot_deg = angle_deg;
    row.x = rigid.way().x_of(angle_deg);
    held.rows.push_back(row);
  }
  const JointForces joints =
      find_joint_forces(rigid, sheet.model().shape(), sheet.base(), held,
                        {.in_motion = false, .from_deg = 0, .filling_forces_n = filling_forces_n});
  std::vector<std::vector<PlaneForces>> all;
  for (std::size_t k = 0; k < pilot_deg.size(); ++k) {
    Forces forces(sheet, sheet.at(pilot_deg[k]).vertices_mm);
    forces.add_joints(joints, static_cast<Index>(k));
    forces.add_filling(rigid.filling(), sheet.at(pilot_deg[k]).length_mm, filling_forces_n[k]);
    all.push_back(forces.take());
  }
  return all;
}

const BucklingStudy::Least& BucklingStudy::least() const {
  assert(!panels.empty());
  return *std::min_element(panels.begin(), panels.end(),
                           [](const auto& a, const auto& b) { return a.factor < b.factor; });
}

BucklingStudy find_buckling(const Sheet& sheet, const EnergyModel::Options& options,
                            const BentPanels& bent) {
  const EnergyModel rigid(sheet, options);
  const std::vector<BucklingPanel> panels =
      buckling_panels(sheet, bent.options.material, bent.thickness_mm);
  BucklingStudy study;
  for (const int facet : sheet.panels().facets) {
    const auto& place = sheet.base().sheet.places[static_cast<std::size_t>(facet)];
    study.panels.push_back({{std::numeric_limits<double>::infinity()}, 0, {place[0], place[1]}});
  }
  std::vector<VectorXd> filling_forces_n;
  for (const BentAngle& angle : bent.angles) {
    if (angle.pilot_deg < bent.options.to_deg) continue;
    study.pilot_deg.push_back(angle.pilot_deg);
    filling_forces_n.push_back(angle.bent.forces_n);
  }
  const auto forces = plane_forces(sheet, rigid, study.pilot_deg, filling_forces_n);
  for (std::size_t a = 0; a < forces.size(); ++a) {
    std::vector<BucklingFactor>& factors = study.factors.emplace_back();
    for (std::size_t k = 0; k < panels.size(); ++k) {
      factors.push_back(buckling_factor(panels[k], forces[a][k]));
      BucklingStudy::Least& least = study.panels[k];
      if (factors[k].factor < least.factor) {
        least = {factors[k], study.pilot_deg[a], least.place};
      }
    }
  }
  return study;
}

}  // namespace misalign::solver
