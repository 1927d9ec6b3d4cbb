// The nearest pair of congruent meshes to one that is off a little.
#include "solver/pattern/isometric_pair.hpp"

#include <gtest/gtest.h>

#include "solver/pattern/perforation.hpp"
#include "tests/solver/designed_mesh.hpp"

namespace misalign::solver {
namespace {

double squared_distance(const FlatVertices& flat, const FoldedVertices& folded,
                        const DesignedMesh& mesh) {
  return (flat - mesh.flat.vertices_mm).squaredNorm() + (folded - mesh.folded_mm).squaredNorm();
}

struct MovedMesh : testing::Test {
  MovedMesh()
      : exact(curved_mesh(6, 6, {2e-4, 1e-4}, 0.5, 3)),
        moved(exact),
        holes(checkerboard(exact.flat, 1)) {
    std::mt19937 words(9);
    std::uniform_real_distribution<double> move_mm(-kMost_mm, kMost_mm);
    for (double& x : moved.flat.vertices_mm.reshaped()) x += move_mm(words);
    for (double& x : moved.folded_mm.reshaped()) x += move_mm(words);
  }
  static constexpr double kMost_mm = 0.01;
  const DesignedMesh exact;
  DesignedMesh moved;
  const std::vector<int> holes;
};

TEST_F(MovedMesh, MisfitsNameTheWorst) {
  EXPECT_LT(largest_length_misfit(exact.flat, {}, exact.folded_mm).mm(), 1e-10);
  EXPECT_LT(largest_plane_misfit(exact.flat, {}, exact.folded_mm).mm, 1e-9);
  DesignedMesh off = exact;
  const int vertex = exact.flat.facets[0][0];  // a corner of the sheet
  off.flat.vertices_mm.col(vertex).x() -= 0.05;
  const LengthMisfit length = largest_length_misfit(off.flat, holes, off.folded_mm);
  EXPECT_TRUE(length.from == vertex || length.to == vertex);
  EXPECT_NEAR(
      length.mm(),
      std::abs(
          (off.flat.vertices_mm.col(length.from) - off.flat.vertices_mm.col(length.to)).norm() -
          (exact.flat.vertices_mm.col(length.from) - exact.flat.vertices_mm.col(length.to)).norm()),
      1e-10);
  // A corner lifted off its panel; the diagonals part by the share of the other three corners.
  const auto& v = exact.flat.facets[0];
  const Eigen::Vector3d up =
      Eigen::Vector3d(exact.folded_mm.col(v[2]) - exact.folded_mm.col(v[0]))
          .cross(Eigen::Vector3d(exact.folded_mm.col(v[3]) - exact.folded_mm.col(v[1])))
          .normalized();
  off.folded_mm.col(vertex) += 0.05 * up;
  const PlaneMisfit plane = largest_plane_misfit(off.flat, holes, off.folded_mm);
  EXPECT_EQ(plane.facet, 0);
  EXPECT_GT(plane.mm, 0.01);
  EXPECT_LT(plane.mm, 0.05);
}

// Congruent, and no farther than the mesh from which it was moved; a step towards that is none of
// the nearest: its first-order rise vanishes.
TEST_F(MovedMesh, PanelsAreCongruentAndNear) {
  const auto pair = nearest_isometric_pair(moved.flat, holes, moved.folded_mm);
  ASSERT_TRUE(pair);
  CreasePattern flat = moved.flat;
  flat.vertices_mm = pair->flat_mm;
  EXPECT_LT(largest_length_misfit(flat, holes, pair->folded_mm).mm(), 1e-10);
  EXPECT_LT(largest_plane_misfit(flat, holes, pair->folded_mm).mm, 1e-9);
  EXPECT_GT(largest_length_misfit(moved.flat, holes, moved.folded_mm).mm(), kMost_mm);
  const double least = squared_distance(pair->flat_mm, pair->folded_mm, moved);
  EXPECT_LT(least, squared_distance(exact.flat.vertices_mm, exact.folded_mm, moved));
  // Pythagoras: the exact mesh, the nearest and the moved form a right angle, to the third order.
  const double between = squared_distance(pair->flat_mm, pair->folded_mm, exact);
  EXPECT_NEAR(least + between, squared_distance(exact.flat.vertices_mm, exact.folded_mm, moved),
              1e-3 * least);
  EXPECT_LT(pair->moved_mm, 3 * kMost_mm);
  EXPECT_NEAR(pair->moved_mm,
              std::max((pair->flat_mm - moved.flat.vertices_mm).colwise().norm().maxCoeff(),
                       (pair->folded_mm - moved.folded_mm).colwise().norm().maxCoeff()),
              1e-15);
}

// Holes are free: panels that are taken out need not be congruent.
TEST_F(MovedMesh, HolesAreFree) {
  const auto pair = nearest_isometric_pair(moved.flat, holes, moved.folded_mm);
  const auto whole = nearest_isometric_pair(moved.flat, {}, moved.folded_mm);
  ASSERT_TRUE(pair && whole);
  CreasePattern flat = moved.flat;
  flat.vertices_mm = pair->flat_mm;
  EXPECT_GT(largest_length_misfit(flat, {}, pair->folded_mm).mm(), 1e-6);
  EXPECT_LT(squared_distance(pair->flat_mm, pair->folded_mm, moved),
            squared_distance(whole->flat_mm, whole->folded_mm, moved));
}

TEST(IsometricPair, NoneNearAMeshThatIsFarOff) {
  DesignedMesh mesh = graded_miura(4, 4, 0.6);
  mesh.folded_mm.setZero();
  EXPECT_FALSE(nearest_isometric_pair(mesh.flat, {}, mesh.folded_mm));
}

}  // namespace
}  // namespace misalign::solver
