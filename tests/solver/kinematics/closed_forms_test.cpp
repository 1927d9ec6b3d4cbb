// Closed forms: known without solving anything.
#include <Eigen/Geometry>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/loop_closure.hpp"
#include "solver/pattern/perforation.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// model.md: unknowns / equations by size, and d.f. = 1 by counting (2.1).
TEST(ClosedForms, UnknownsAndEquationsOfEverySize) {
  struct Size {
    int rows, columns, unknowns, equations;
  };
  for (const Size& size : {Size{4, 4, 19, 18}, Size{6, 6, 55, 54}, Size{8, 6, 79, 78},
                           Size{8, 8, 115, 114}, Size{10, 10, 199, 198}, Size{20, 20, 979, 978}}) {
    const TestSheet sheet(size.rows, size.columns);
    EXPECT_EQ(sheet.mechanism.unknowns, size.unknowns);
    EXPECT_EQ(sheet.mechanism.equations, size.equations);
    EXPECT_EQ(counted_mobility(sheet.base.sheet, sheet.base.holes), 1);
  }
  const TestSheet paper(6, 6);
  EXPECT_EQ(paper.mechanism.creases.size(), 28u);
  EXPECT_EQ(paper.mechanism.balls.size(), 9u);
  EXPECT_EQ(TestSheet(4, 4).mechanism.creases.size(), 16u);
  EXPECT_EQ(TestSheet(4, 4).mechanism.balls.size(), 1u);
}

TEST(ClosedForms, CountingOnWholeSheets) {
  for (const int rows : {4, 5, 6, 9}) {
    for (const int columns : {4, 6, 7}) {
      const TestSheet sheet(rows, columns);
      EXPECT_EQ(counted_mobility(sheet.base.sheet, {}), -(rows - 2) * (columns - 2) + 1);
      EXPECT_EQ(counted_mobility(sheet.base.sheet, {columns + 1}), -(rows - 2) * (columns - 2) + 3);
    }
  }
}

// Closure of the Miura-ori's own folding, a formula; rounding grows with the sheet (6e-14 on 20 x
// 20).
TEST(ClosedForms, BaseFoldingClosesFromFlatToFlat) {
  for (const int side : {4, 6, 10, 20}) {
    for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
      const TestSheet sheet(side, side, holes);
      std::vector<double> residual(sheet.mechanism.equations);
      for (const double pilot_deg : {0.0, 0.01, 1.0, 45.0, 90.0, 135.0, 179.0, 179.999, 180.0}) {
        const auto state = sheet.folded(pilot_deg);
        EXPECT_LE(
            evaluate<double>(sheet.mechanism, sheet.geometry, state, residual.data(), nullptr),
            2e-13)
            << side << " " << holes << " " << pilot_deg;
      }
    }
  }
}

// The folded Miura-ori as coordinates, from its one-parameter closed form: with half the zigzag's
// fold angle h, the straight creases tilt so that the cell's width shrinks; here the dihedral
// angles at every crease are recomputed from the normals of the reconstructed facets, which must be
// the ones put in.
TEST(ClosedForms, DihedralAnglesFromVertexCoordinates) {
  const TestSheet sheet(6, 6);
  const FoldedShape shape(sheet.base.sheet, sheet.base.holes, sheet.mechanism);
  for (const double pilot_deg : {1.0, 37.0, 90.0, 150.0, 179.0}) {
    const auto state = sheet.folded(pilot_deg);
    const Eigen::Matrix3Xd p = shape.vertices_mm(sheet.geometry, state);
    const auto normal = [&](int facet) -> Eigen::Vector3d {
      const auto& v = sheet.base.sheet.facets[facet];
      return (p.col(v[2]) - p.col(v[0]))
          .eval()
          .cross((p.col(v[3]) - p.col(v[1])).eval())
          .normalized();
    };
    for (std::size_t i = 0; i < sheet.mechanism.creases.size(); ++i) {
      const Crease& crease = sheet.mechanism.creases[i];
      const Eigen::Vector3d axis = (p.col(crease.b) - p.col(crease.a)).normalized();
      const Eigen::Vector3d left = normal(crease.left), right = normal(crease.right);
      // Right is left turned by -rho about a -> b.
      const double rho_deg = std::atan2(-left.cross(right).dot(axis), left.dot(right)) / kRadPerDeg;
      EXPECT_NEAR(rho_deg, angle_deg(state.creases[i]), 1e-9);
      const bool zigzag = crease.b - crease.a > 1;  // to the next line of vertices
      const double cos_alpha = 40 / std::hypot(40.0, 80.0);
      const double expected_deg =
          zigzag ? pilot_deg
                 : 2 * std::atan(cos_alpha * std::tan(pilot_deg * kRadPerDeg / 2)) / kRadPerDeg;
      EXPECT_NEAR(std::abs(rho_deg), expected_deg, 1e-9);
    }
  }
}

TEST(ClosedForms, UnshiftedMiuraKeepsEveryDiagonalAndIsInactive) {
  for (const int side : {4, 6}) {
    const TestSheet sheet(side, side);
    PathPlanOptions to_179;
    to_179.end_deg = 179;
    const auto history = sheet.history(sheet.base.sheet.vertices_mm, to_179);
    ASSERT_EQ(history.stations.size(), 179u);
    for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
      EXPECT_LE((history.length_mm.col(d).array() - history.flat_mm[d]).abs().maxCoeff(), 1e-10);
    }
    EXPECT_EQ(history.verdict.first_fault, Fault::inactive_diagonal);
    EXPECT_EQ(history.verdict.deploys_from_sample, 0);
  }
}

}  // namespace
}  // namespace misalign::solver
