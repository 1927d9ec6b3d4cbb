// Meshes that do not fold rigidly, taken as sheets: the same path as from another base, a target
// that the path reaches, and what campaigns take.
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "solver/records/history.hpp"
#include "tests/schema/pattern/fold_meshes.hpp"

namespace misalign::schema {
namespace {

/// Vertices of a mesh, all shifted by up to so many mm, as displacements too.
Json shift(Json& mesh, double most_mm, unsigned seed) {
  std::mt19937 words(seed);
  std::uniform_real_distribution<double> shift_mm(-most_mm, most_mm);
  Json displacements = Json::object();
  int v = 0;
  for (Json& point : mesh["vertices_coords"]) {
    const double x = shift_mm(words), y = shift_mm(words);
    point = {point[0].get<double>() + x, point[1].get<double>() + y};
    displacements[solver::vertex_label(v++)] = {x, y};
  }
  return displacements;
}

/// Without the panels of the odd checkerboard, and without letters there.
Json perforated(Json mesh, const solver::PerforatedSheet& base) {
  Json faces = Json::array();
  for (int f = 0; f < base.sheet.facet_count(); ++f) {
    if (!std::binary_search(base.holes.begin(), base.holes.end(), f)) {
      faces.push_back(base.sheet.facets[f]);
      continue;
    }
    for (int k = 0; k < 4; ++k) {
      const auto [a, b] = std::minmax(base.sheet.facets[f][k], base.sheet.facets[f][(k + 1) % 4]);
      mesh["edges_assignment"][edge_index(mesh, a, b)] = "B";
    }
  }
  mesh["faces_vertices"] = faces;
  return mesh;
}

/// The path is the sheet's alone: 1e-9 mm, a hundred times what converged paths of other equations
/// differ by.
void expect_same_path(const Pattern& mesh, const Pattern& expected) {
  EXPECT_LT((mesh.vertices_mm() - expected.vertices_mm()).cwiseAbs().maxCoeff(), 1e-12);
  const auto a = history_of(mesh), b = history_of(expected);
  EXPECT_EQ(a.verdict.deploys_from_sample, b.verdict.deploys_from_sample);
  EXPECT_EQ(a.verdict.first_fault, b.verdict.first_fault);
  EXPECT_EQ(a.verdict.where, b.verdict.where);
  EXPECT_NEAR(a.path.fold_limit_deg, b.path.fold_limit_deg, 1e-6);
  ASSERT_EQ(a.length_mm.rows(), b.length_mm.rows());
  ASSERT_GT(a.length_mm.rows(), 90);
  EXPECT_LT((a.length_mm - b.length_mm).topRows(90).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(NearMesh, FoldsAsTheMiuraWithTheSameShifts) {
  for (const double most_mm : {2.0, 6.0}) {
    Json mesh = miura_mesh(6, 6), miura = pattern_of(mesh);
    miura["displacements_mm"] = shift(mesh, most_mm, 11);
    const Pattern expected = good(miura);
    for (const Json& plain : {mesh, perforated(mesh, expected.base)}) {
      const Pattern read = good(pattern_of(plain));
      EXPECT_GT(read.mesh_off_mm, 0.1 * most_mm);
      EXPECT_LT(read.mesh_off_mm, 1.5 * most_mm);
      EXPECT_EQ(read.mesh_off_mm, std::sqrt(read.shifts_mm.colwise().squaredNorm().maxCoeff()));
      ASSERT_EQ(read.reading.size(), 1u);
      EXPECT_NE(read.reading[0].find("off by at most"), std::string::npos);
      expect_same_path(read, expected);
      // As a file it names its base, which folds.
      const Pattern again = good(pattern_json(read, read.shifts_mm));
      EXPECT_EQ(again.mesh_off_mm, 0);
      EXPECT_EQ(again.vertices_mm(), read.vertices_mm());
      EXPECT_EQ(again.base.sheet.places, read.base.sheet.places);
      EXPECT_EQ(again.base.sheet.panel_width_mm, read.base.sheet.panel_width_mm);
    }
  }
}

TEST(NearMesh, AddsDisplacementsToItsOwn) {
  Json mesh = miura_mesh(4, 4);
  shift(mesh, 1, 3);
  Json pattern = pattern_of(mesh);
  const Eigen::Vector2d before = good(pattern).vertices_mm().col(12);
  pattern["displacements_mm"] = {{"A13", {0.5, -0.25}}};
  const Eigen::Vector2d moved = good(pattern).vertices_mm().col(12) - before;
  EXPECT_LT((moved - Eigen::Vector2d(0.5, -0.25)).norm(), 1e-12);
}

// Made by tests/fixtures/developable.py, from coordinates of its target: the path of the perforated
// mesh leads there, with every crease at the target's fold angle.
TEST(NearMesh, OfADevelopableMeshReachesItsTarget) {
  const Json mesh = read_json_file(MISALIGN_SOURCE_DIR "/tests/fixtures/developable-6x6.fold");
  const Pattern read = good(pattern_of(mesh));
  EXPECT_GT(read.mesh_off_mm, 0.5);
  constexpr Eigen::Index kTarget = 59;  // the sample at 60 deg
  const auto history = history_of(read);
  ASSERT_GT(history.length_mm.rows(), kTarget);
  const solver::Mechanism mechanism = solver::build_mechanism(read.base);
  for (std::size_t c = 0; c < mechanism.creases.size(); ++c) {
    const solver::Crease& crease = mechanism.creases[c];
    const double target_deg =
        mesh["edges_foldAngle"][edge_index(mesh, crease.a, crease.b)].get<double>();
    EXPECT_NEAR(history.fold_angle_deg(kTarget, static_cast<Eigen::Index>(c)), target_deg, 1e-7);
  }
  // Its holes are as long there as flat, so that no diagonal goes one way (Rolle).
  for (Eigen::Index d = 0; d < history.length_mm.cols(); ++d) {
    EXPECT_NEAR(history.length_mm(kTarget, d), history.flat_mm[static_cast<std::size_t>(d)], 1e-9);
  }
  EXPECT_LT(history.verdict.deploys_from_sample, 60);
}

Json campaign_of(const Json& mesh) {
  return {
      {"name", "near"}, {"pattern", pattern_of(mesh)}, {"misalignment", {{"amplitude_mm", 0.4}}}};
}

TEST(NearMesh, CampaignsDrawAroundABaseThatStandsForIt) {
  Json mesh = read_json_file(MISALIGN_SOURCE_DIR "/search/patterns/angle-array-6x6.fold");
  const Json as_it_is = mesh["vertices_coords"];
  for (Json& point : mesh["vertices_coords"]) {
    for (Json& x : point) x = std::round(x.get<double>() * 1e3) / 1e3;
  }
  const Campaign campaign = read_campaign(campaign_of(mesh), "test");
  EXPECT_GT(campaign.pattern.mesh_off_mm, 1e-4);
  EXPECT_LT(campaign.pattern.mesh_off_mm, 2e-3);
  EXPECT_TRUE(campaign.pattern.shifts_mm.isZero(0));
  for (int v = 0; v < campaign.pattern.base.sheet.vertex_count(); ++v) {
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(campaign.pattern.base.sheet.vertices_mm(k, v), as_it_is[v][k].get<double>(),
                  2e-3);
    }
  }
  const Campaign again = read_campaign(campaign_json(campaign), "test");
  EXPECT_EQ(identity(again), identity(campaign));
  EXPECT_EQ(again.pattern.mesh_off_mm, 0);

  Json far = miura_mesh(6, 6);
  shift(far, 4, 1);
  try {
    read_campaign(campaign_of(far), "test");
    ADD_FAILURE() << "a mesh far from its base was taken";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("does not fold rigidly, and the nearest sheet found"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace misalign::schema
