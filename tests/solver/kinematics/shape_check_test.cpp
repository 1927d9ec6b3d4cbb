// Shapes made by hand, and folded sheets with one coordinate moved.
#include "solver/kinematics/shape_check.hpp"

#include <cmath>

#include "solver/linear/newton.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// Three unit squares in an L, folded up by 90 degrees along x = 1 and along y = 1: a cube's corner,
// where vertices 5 and 7 meet.
struct CubeCorner {
  Eigen::Matrix2Xd flat{{0, 1, 2, 0, 1, 2, 0, 1}, {0, 0, 0, 1, 1, 1, 2, 2}};
  Eigen::Matrix3Xd folded{
      {0, 1, 1, 0, 1, 1, 0, 1}, {0, 0, 0, 1, 1, 1, 1, 1}, {0, 0, 1, 0, 0, 1, 1, 1}};
  std::vector<std::array<int, 4>> panels = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}};
  std::vector<FoldLine> folds = {{1, 4, 0, 1, 1}, {3, 4, 2, 0, 1}};

  Eigen::Matrix3Xd corners() const {
    Eigen::Matrix3Xd corners(3, 4 * panels.size());
    Eigen::Index next = 0;
    for (const auto& panel : panels) {
      for (const int v : panel) corners.col(next++) = folded.col(v);
    }
    return corners;
  }
  ShapeCheck::Errors errors(const std::vector<double>& claimed_deg = {90, 90}) const {
    ShapeCheck check(flat, panels, folds);
    check.see(folded, corners(), claimed_deg);
    return check.worst();
  }
};

TEST(ShapeCheck, CubeCornerIsSound) {
  const ShapeCheck::Errors errors = CubeCorner().errors();
  EXPECT_EQ(errors.length_mm, 0);
  EXPECT_EQ(errors.planarity_mm, 0);
  EXPECT_EQ(errors.coincidence_mm, 0);
  EXPECT_LE(errors.angle_deg, 1e-13);
  EXPECT_LE(errors.beyond_deg, 0);
  EXPECT_EQ(errors.wrong_sign, -1);
}

TEST(ShapeCheck, ClaimsAreCompared) {
  EXPECT_NEAR(CubeCorner().errors({90, 89.5}).angle_deg, 0.5, 1e-12);
  EXPECT_NEAR(CubeCorner().errors({-90, 90}).angle_deg, 180, 1e-12);
  CubeCorner mountain;
  mountain.folds[1].sign = -1;
  EXPECT_EQ(mountain.errors().wrong_sign, 1);
  CubeCorner below;  // the same seen from the other side: both are mountains
  below.folded.row(2) *= -1;
  EXPECT_EQ(below.errors({-90, -90}).wrong_sign, 1);
  EXPECT_LE(below.errors({-90, -90}).angle_deg, 1e-13);
}

// Corner 2 of a square panel lifted by h: to first order the diagonals pass h / 2 apart, while no
// length changes by more than h^2.
TEST(ShapeCheck, BentQuadrilateralIsNotPlane) {
  const double h = 1e-6;
  const Eigen::Matrix2Xd flat{{0, 1, 1, 0}, {0, 0, 1, 1}};
  Eigen::Matrix3Xd folded = Eigen::Matrix3Xd::Zero(3, 4);
  folded.topRows(2) = flat;
  folded(2, 2) = h;
  ShapeCheck check(flat, {{0, 1, 2, 3}}, {});
  check.see(folded, folded, {});
  EXPECT_NEAR(check.worst().planarity_mm, h / 2, 1e-3 * h);
  EXPECT_LE(check.worst().length_mm, h * h);
}

TEST(ShapeCheck, OneMovedVertexIsSeen) {
  CubeCorner moved;
  const Eigen::Matrix3Xd corners = moved.corners();
  moved.folded(0, 0) -= 1e-6;
  ShapeCheck check(moved.flat, moved.panels, moved.folds);
  check.see(moved.folded, corners, {90, 90});
  EXPECT_NEAR(check.worst().length_mm, 1e-6, 1e-15);
  EXPECT_NEAR(check.worst().coincidence_mm, 1e-6, 1e-15);
}

TEST(ShapeCheck, WhatIsNoNumberIsNotSound) {
  CubeCorner lost;
  lost.folded(1, 1) = std::nan("");
  const ShapeCheck::Errors errors = lost.errors();
  EXPECT_TRUE(std::isnan(errors.length_mm));
  EXPECT_TRUE(std::isnan(errors.coincidence_mm));
  EXPECT_NE(errors.wrong_sign, -1);
}

// A hinge turned through 180 degrees step by step: the normals alone would say -170 at 190.
TEST(ShapeCheck, AnglesBeyondHalfATurn) {
  const Eigen::Matrix2Xd flat{{0, 1, 2, 0, 1, 2}, {0, 0, 0, 1, 1, 1}};
  ShapeCheck check(flat, {{0, 1, 4, 3}, {1, 2, 5, 4}}, {{1, 4, 0, 1, 1}});
  for (int deg = 10; deg <= 190; deg += 10) {
    Eigen::Matrix3Xd folded = Eigen::Matrix3Xd::Zero(3, 6);
    folded.topRows(2) = flat;
    for (const int v : {2, 5}) {
      folded(0, v) = 1 + std::cos(deg * kRadPerDeg);
      folded(2, v) = std::sin(deg * kRadPerDeg);
    }
    Eigen::Matrix3Xd corners(3, 8);
    corners << folded(Eigen::all, {0, 1, 4, 3}), folded(Eigen::all, {1, 2, 5, 4});
    check.see(folded, corners, {static_cast<double>(deg)});
  }
  EXPECT_NEAR(check.worst().beyond_deg, 10, 1e-12);
  EXPECT_LE(check.worst().angle_deg, 1e-12);
  EXPECT_EQ(check.worst().wrong_sign, -1);
}

// Folded sheets are sound. One fold of the state turned by 1e-6 rad opens loops: where panels are
// placed over this fold, others come apart by about 1e-6 of their size; where they are not, the
// claimed angle is not the one between the panels.
TEST(ShapeCheck, OpenLoopsAreSeen) {
  const TestSheet sheet(6, 6);
  const CreasePattern& pattern = sheet.base.sheet;
  const FoldedShape shape(pattern, sheet.base.holes, sheet.mechanism);
  std::vector<std::array<int, 4>> panels;
  std::vector<int> panel_of(pattern.facets.size(), -1);
  for (int f = 0; f < pattern.facet_count(); ++f) {
    if (std::binary_search(sheet.base.holes.begin(), sheet.base.holes.end(), f)) continue;
    panel_of[f] = static_cast<int>(panels.size());
    panels.push_back(pattern.facets[f]);
  }
  std::vector<FoldLine> folds;
  for (const Crease& crease : sheet.mechanism.creases) {
    folds.push_back({crease.a, crease.b, panel_of[crease.left], panel_of[crease.right],
                     sheet.base.folding.assignment()[crease.edge]});
  }
  const auto errors_of = [&](const FoldState<double>& state) {
    std::vector<double> claimed_deg;
    for (const auto& rho : state.creases) {
      claimed_deg.push_back(2 * std::atan2(rho.s, rho.c) / kRadPerDeg);
    }
    ShapeCheck check(pattern.vertices_mm, panels, folds);
    check.see(shape.vertices_mm(sheet.geometry, state), shape.corners_mm(sheet.geometry, state),
              claimed_deg);
    return check.worst();
  };
  const auto closed = sheet.folded(120);
  EXPECT_LE(errors_of(closed).coincidence_mm, 1e-10);  // of lengths up to 500 mm, to rounding
  EXPECT_LE(errors_of(closed).length_mm, 1e-10);
  EXPECT_LE(errors_of(closed).angle_deg, 1e-10);
  EXPECT_EQ(errors_of(closed).wrong_sign, -1);
  int apart = 0, otherwise = 0;
  for (std::size_t i = 0; i < closed.creases.size(); ++i) {
    auto open = closed;
    open.creases[i] = open.creases[i].turned(1e-6);
    const ShapeCheck::Errors errors = errors_of(open);
    EXPECT_LE(errors.coincidence_mm, 1e-3) << "crease " << i;
    if (errors.coincidence_mm >= 4e-5) {
      ++apart;
    } else {
      EXPECT_NEAR(errors.angle_deg, 1e-6 / kRadPerDeg, 1e-9) << "crease " << i;
      ++otherwise;
    }
  }
  EXPECT_GE(apart, 10);
  EXPECT_GE(otherwise, 5);
}

}  // namespace
}  // namespace misalign::solver
