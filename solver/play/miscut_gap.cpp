#include "solver/play/miscut_gap.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A vertex at which a joint holds two panels together; column -1 is the panel at rest.
struct HeldPoint {
  int vertex;
  int facets[2];
  Index columns[2];  // first of their six unknowns
};

std::vector<HeldPoint> points_of(const Sheet& sheet) {
  const auto column = [&](int facet) -> Index {
    const int panel = sheet.panels().panel_of(facet);
    return panel == 0 ? -1 : 6 * (panel - 1);
  };
  std::vector<HeldPoint> points;
  const auto add = [&](int vertex, int from_facet, int to_facet) {
    points.push_back({vertex, {from_facet, to_facet}, {column(from_facet), column(to_facet)}});
  };
  for (const Crease& crease : sheet.mechanism().creases) {
    for (const int end : {crease.a, crease.b}) add(end, crease.left, crease.right);
  }
  for (const BallJoint& ball : sheet.mechanism().balls) {
    add(ball.vertex, ball.from_facet, ball.to_facet);
  }
  return points;
}

// Matrix from a spin to the velocity at this place.
Matrix3d moved_by_spin(const Vec3<double>& at) {
  Matrix3d matrix;
  matrix << 0, at.z, -at.y, -at.z, 0, at.x, at.y, -at.x, 0;
  return matrix;
}

// Largest distance in each copy; points have three rows each.
Eigen::VectorXd largest_mm(const Eigen::MatrixXd& left_mm) {
  assert(left_mm.rows() % 3 == 0);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(left_mm.cols());
  for (Index point = 0; point < left_mm.rows(); point += 3) {
    largest = largest.cwiseMax(left_mm.middleRows(point, 3).colwise().norm().transpose());
  }
  return largest;
}

}  // namespace

double MiscutGap::quantile_mm(double share, Index k) const {
  assert(share >= 0 && share <= 1);
  assert(open_mm.rows() > 0 && k >= 0 && k < open_mm.cols());
  Eigen::VectorXd sorted = open_mm.col(k);
  std::ranges::sort(sorted);
  const auto last = static_cast<double>(sorted.size() - 1);
  return sorted(static_cast<Index>(std::ceil(share * last)));
}

Index MiscutGap::worst_angle() const {
  assert(open_mm.cols() > 0);
  Index worst = 0;
  for (Index k = 1; k < open_mm.cols(); ++k) {
    if (quantile_mm(0.5, k) > quantile_mm(0.5, worst)) worst = k;
  }
  return worst;
}

MiscutGap find_miscut_gaps(const Sheet& sheet, const std::vector<Eigen::Matrix2Xd>& errors_mm,
                           const std::vector<Index>& rows) {
  assert(!errors_mm.empty() && !rows.empty());
  assert(errors_mm.front().cols() == sheet.vertices_mm().cols());
  const std::vector<HeldPoint> points = points_of(sheet);
  const Index unknowns = 6 * (std::ssize(sheet.panels().facets) - 1);
  SheetGeometry<double> geometry;
  place(sheet.mechanism(), sheet.vertices_mm(), geometry);
  MiscutGap study;
  study.open_mm.resize(std::ssize(errors_mm), std::ssize(rows));
  Eigen::MatrixXd moves(3 * std::ssize(points), unknowns);
  Eigen::MatrixXd open_mm(moves.rows(), study.open_mm.rows());
  FoldedShape::Points<double> folded;
  for (Index k = 0; k < std::ssize(rows); ++k) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(k)]);
    assert(row < sheet.states().size());
    study.pilot_deg.push_back(sheet.history().stations[row].pilot_deg);
    sheet.model().shape().place(geometry, sheet.states()[row].state, folded);
    moves.setZero();
    for (std::size_t p = 0; p < points.size(); ++p) {
      const HeldPoint& point = points[p];
      const Index first = 3 * static_cast<Index>(p);
      const Vec3<double>& at = folded.vertices[static_cast<std::size_t>(point.vertex)];
      Eigen::Matrix<double, 3, 2> apart = Eigen::Matrix<double, 3, 2>::Zero();
      for (const int side : {0, 1}) {
        const double sign = side == 0 ? 1 : -1;
        const Mat3<double>& turn =
            folded.facets[static_cast<std::size_t>(point.facets[side])].rotation;
        apart.col(0) += sign * Vector3d(turn.cx.x, turn.cx.y, turn.cx.z);
        apart.col(1) += sign * Vector3d(turn.cy.x, turn.cy.y, turn.cy.z);
        if (point.columns[side] < 0) continue;
        moves.block<3, 3>(first, point.columns[side]) = sign * Matrix3d::Identity();
        moves.block<3, 3>(first, point.columns[side] + 3) = sign * moved_by_spin(at);
      }
      for (Index copy = 0; copy < open_mm.cols(); ++copy) {
        open_mm.col(copy).segment<3>(first) =
            apart * errors_mm[static_cast<std::size_t>(copy)].col(point.vertex);
      }
    }
    // The sheet's folding motion opens no joint: its amount is arbitrary.
    const Eigen::LDLT<Eigen::MatrixXd> normal(moves.transpose() * moves);
    const Eigen::MatrixXd put = normal.solve(moves.transpose() * open_mm);
    study.open_mm.col(k) = largest_mm(open_mm - moves * put);
  }
  return study;
}

}  // namespace misalign::solver
