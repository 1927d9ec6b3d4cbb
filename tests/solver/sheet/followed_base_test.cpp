// Bases that are followed from a folded state: against a closed form, and against vertex
// coordinates that are followed from next to flat.
#include "solver/sheet/followed_base.hpp"

#include <gtest/gtest.h>

#include "solver/linear/mobility.hpp"
#include "tests/solver/designed_mesh.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

FollowedBase followed(const DesignedMesh& mesh, const std::vector<int>& holes) {
  const auto found =
      follow_from_target(mesh.flat, holes, default_pilot(mesh.flat, holes), mesh.folded_mm);
  const auto* const base = std::get_if<FollowedBase>(&found);
  EXPECT_TRUE(base) << static_cast<int>(std::get<NoFollowedBase>(found).cause);
  return base ? *base : FollowedBase{};
}

/// Distance of vertices after the best rigid motion.
double apart_mm(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  const Eigen::Isometry3d onto(Eigen::umeyama(a, b, false));
  return (onto * a - b).colwise().norm().maxCoeff();
}

// Fold angles of a Miura-ori that is perforated are those of the whole one. States are rounded to
// 2^-26.
TEST(FollowedBase, MiuraOriHasItsClosedForm) {
  const DesignedMesh mesh = graded_miura(6, 6, 0.7);
  const std::vector<int> holes = checkerboard(mesh.flat, 1);
  const FollowedBase base = followed(mesh, holes);
  std::vector<int> signs = base.folding.assignment();
  for (int& sign : signs) sign *= base.folding.side();
  const auto whole = fold_sequentially(mesh.flat, signs, base.folding.pilot_edge());
  ASSERT_TRUE(std::holds_alternative<BaseFolding>(whole));
  for (double pilot_deg = 2; pilot_deg < 170; pilot_deg += 12) {
    const auto expected = std::get<BaseFolding>(whole).fold_angles(half_angle_of_deg(pilot_deg));
    const auto angles = base.folding.fold_angles(half_angle_of_deg(pilot_deg));
    for (std::size_t e = 0; e < angles.size(); ++e) {
      if (base.folding.assignment()[e] == 0) continue;
      EXPECT_EQ(base.folding.assignment()[e], angles[e].s > 0 ? 1 : -1) << e;
      EXPECT_NEAR(angle_deg(angles[e]), angle_deg(expected[e]), 1e-5) << e << " at " << pilot_deg;
    }
  }
}

// Developable meshes with one target do not fold as a whole; by each perforation their paths leave
// flat and come to the target.
TEST(FollowedBase, PerforationsOfCurvedMeshesFold) {
  for (const Eigen::Vector2d& curvatures :
       {Eigen::Vector2d(6e-4, -4e-4), Eigen::Vector2d(2e-3, 2e-3), Eigen::Vector2d(-1e-3, 0),
        Eigen::Vector2d(0, 5e-4)}) {
    const DesignedMesh mesh = curved_mesh(6, 6, curvatures, 0.5, 7);
    const auto sets = separate_facets(mesh.flat, 8, 100);
    ASSERT_TRUE(sets && sets->size() == 2);
    for (const std::vector<int>& holes : *sets) {
      const FollowedBase base = followed(mesh, holes);
      EXPECT_LT(base.joined_mm, 1e-9);
      std::vector<int> signs = base.folding.assignment();
      for (int& sign : signs) sign *= base.folding.side();
      EXPECT_TRUE(std::holds_alternative<NoBaseFolding>(
          fold_sequentially(mesh.flat, signs, base.folding.pilot_edge())));
    }
  }
}

// Vertex coordinates follow a path from next to flat to the target.
TEST(FollowedBase, PathOfACurvedMeshJoinsFlatAndTarget) {
  const DesignedMesh mesh = curved_mesh(6, 6, {2e-4, 1.5e-4}, 0.5, 5);
  ASSERT_LT(largest_length_misfit(mesh.flat, {}, mesh.folded_mm).mm(), 1e-10);
  for (const std::vector<int>& holes : {checkerboard(mesh.flat, 1), checkerboard(mesh.flat, 0)}) {
    const FollowedBase base = followed(mesh, holes);
    const PerforatedSheet perforated{mesh.flat, holes, base.folding};
    EXPECT_TRUE(measured_mobility(mesh.flat, holes, base.folding).is_one());
    const OwnSheet own(perforated, Eigen::Matrix2Xd::Zero(2, mesh.flat.vertex_count()),
                       {.end_deg = base.folding.end_deg()});
    ASSERT_TRUE(own.sheet.way());
    EXPECT_LT(apart_mm(own.sheet.at(base.target_deg).vertices_mm, mesh.folded_mm), 1e-9);
    constexpr double kStart_deg = 10;
    VertexCoordinates coordinates(perforated, mesh.flat.vertices_mm,
                                  own.sheet.at(kStart_deg).vertices_mm, kStart_deg);
    ASSERT_TRUE(coordinates.fold_to(base.target_deg));
    EXPECT_LT(apart_mm(coordinates.points_mm(), mesh.folded_mm), 1e-7);
  }
}

}  // namespace
}  // namespace misalign::solver
