#include "solver/kinematics/measured_state.hpp"

#include <Eigen/Geometry>
#include <cassert>

namespace misalign::solver {
namespace {

// Corners of the facets, flat or folded, in columns.
Eigen::Matrix<double, 3, 4> corners_of(const std::array<int, 4>& facet,
                                       const Eigen::Matrix3Xd& vertices_mm) {
  Eigen::Matrix<double, 3, 4> corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = vertices_mm.col(facet[static_cast<std::size_t>(k)]);
  return corners;
}

// Turns of panels relative to the flat sheet.
class PanelTurns {
 public:
  PanelTurns(const CreasePattern& sheet, const Eigen::Matrix3Xd& folded_mm)
      : sheet_(sheet),
        flat_mm_(Eigen::Matrix3Xd::Zero(3, folded_mm.cols())),
        folded_mm_(folded_mm) {
    flat_mm_.topRows<2>() = sheet.vertices_mm;
  }

  // The turn on crossing from a panel to another, in the frame of the first, with w >= 0.
  Eigen::Quaterniond between(int from, int to) const {
    const Eigen::Quaterniond turn(turn_of(from).transpose() * turn_of(to));
    return turn.w() < 0 ? Eigen::Quaterniond(-turn.coeffs()) : turn;
  }

 private:
  Eigen::Matrix3d turn_of(int facet) const {
    const auto& corners = sheet_.facets[static_cast<std::size_t>(facet)];
    return Eigen::umeyama(corners_of(corners, flat_mm_), corners_of(corners, folded_mm_), false)
        .topLeftCorner<3, 3>();
  }

  const CreasePattern& sheet_;
  Eigen::Matrix3Xd flat_mm_;
  const Eigen::Matrix3Xd& folded_mm_;
};

}  // namespace

FoldState<double> measured_state(const Mechanism& mechanism, const CreasePattern& sheet,
                                 const Eigen::Matrix3Xd& folded_mm) {
  assert(folded_mm.cols() == sheet.vertices_mm.cols());
  Eigen::Matrix3Xd seen_mm = folded_mm;
  seen_mm.row(2) *= mechanism.side;
  const PanelTurns turns(sheet, seen_mm);
  FoldState<double> state;
  for (const Crease& crease : mechanism.creases) {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    axis.head<2>() =
        (sheet.vertices_mm.col(crease.b) - sheet.vertices_mm.col(crease.a)).normalized();
    const Eigen::Quaterniond turn = turns.between(crease.left, crease.right);
    state.creases.push_back(half_angle_of_ratio(-axis.dot(turn.vec()), turn.w()));
  }
  for (const BallJoint& ball : mechanism.balls) {
    const Eigen::Quaterniond turn = turns.between(ball.from_facet, ball.to_facet);
    state.balls.push_back({turn.w(), turn.x(), turn.y(), turn.z()});
  }
  return state;
}

}  // namespace misalign::solver
