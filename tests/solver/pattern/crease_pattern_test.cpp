#include "solver/pattern/crease_pattern.hpp"

#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// Table 1 prints every vertex of the sheet (unshifted ones without an asterisk).
TEST(CreasePattern, VerticesOfThePaper) {
  const TestSheet sheet(6, 6);
  const auto& v = sheet.base.sheet.vertices_mm;
  const auto at = [&](int label) { return Eigen::Vector2d(v.col(label - 1)); };
  EXPECT_EQ(at(1), Eigen::Vector2d(0, 0));
  EXPECT_EQ(at(7), Eigen::Vector2d(520, 0));
  EXPECT_EQ(at(8), Eigen::Vector2d(0, 80));
  EXPECT_EQ(at(9), Eigen::Vector2d(120, 80));
  EXPECT_EQ(at(14), Eigen::Vector2d(520, 80));
  EXPECT_EQ(at(17), Eigen::Vector2d(160, 160));
  EXPECT_EQ(at(26), Eigen::Vector2d(360, 240));
  EXPECT_EQ(at(49), Eigen::Vector2d(520, 480));
}

TEST(CreasePattern, MeshOfASheet) {
  const TestSheet sheet(6, 8);
  const CreasePattern& mesh = sheet.base.sheet;
  EXPECT_EQ(mesh.vertex_count(), 7 * 9);
  EXPECT_EQ(mesh.facet_count(), 6 * 8);
  // Euler's formula for a disk: V - E + F = 1.
  EXPECT_EQ(mesh.vertex_count() - static_cast<int>(mesh.edges.size()) + mesh.facet_count(), 1);
  EXPECT_EQ(interior_vertices(mesh).size(), 5u * 7u);
  EXPECT_EQ(ring_vertices(mesh).size(), 5u * 7u - 3u * 5u);
  EXPECT_TRUE(nonconvex_facets(mesh, mesh.vertices_mm).empty());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    EXPECT_EQ(find_edge(mesh, mesh.edges[e].b, mesh.edges[e].a), static_cast<int>(e));
    // The left facet lies left of a -> b.
    const Edge& edge = mesh.edges[e];
    const Eigen::Vector2d along = mesh.vertices_mm.col(edge.b) - mesh.vertices_mm.col(edge.a);
    for (const int facet : {edge.left, edge.right}) {
      if (facet < 0) continue;
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      for (const int v : mesh.facets[facet]) centre += mesh.vertices_mm.col(v) / 4;
      const Eigen::Vector2d to = centre - mesh.vertices_mm.col(edge.a);
      EXPECT_EQ(along.x() * to.y() - along.y() * to.x() > 0, facet == edge.left);
    }
  }
  EXPECT_EQ(find_edge(mesh, 0, 2), -1);
}

TEST(CreasePattern, FacetsAroundAVertexTurnCounterClockwise) {
  const TestSheet sheet(6, 6);
  const CreasePattern& mesh = sheet.base.sheet;
  EXPECT_TRUE(facets_around(mesh, 0).empty());
  EXPECT_TRUE(facets_around(mesh, 3).empty());
  for (const int v : interior_vertices(mesh)) {
    const std::vector<int> ring = facets_around(mesh, v);
    ASSERT_EQ(ring.size(), 4u);
    for (int k = 0; k < 4; ++k) {
      const auto direction = [&](int facet) {
        Eigen::Vector2d centre = Eigen::Vector2d::Zero();
        for (const int corner : mesh.facets[facet]) centre += mesh.vertices_mm.col(corner) / 4;
        return Eigen::Vector2d(centre - mesh.vertices_mm.col(v));
      };
      const Eigen::Vector2d now = direction(ring[k]), next = direction(ring[(k + 1) % 4]);
      EXPECT_GT(now.x() * next.y() - now.y() * next.x(), 0);
    }
  }
}

// Both sides of the bound: no corner of the squares spoils a facet just below it, one does just
// above.
TEST(CreasePattern, SafeAmplitudeIsSharp) {
  const TestSheet sheet(6, 6);
  const CreasePattern& mesh = sheet.base.sheet;
  const std::vector<int> shifted = interior_vertices(mesh);
  const double safe = largest_safe_amplitude_mm(mesh, shifted);
  const auto spoiled = [&](double amplitude) {
    for (const auto& facet : mesh.facets) {
      for (int signs = 0; signs < 256; ++signs) {
        FlatVertices vertices = mesh.vertices_mm;
        for (int k = 0; k < 4; ++k) {
          if (!std::binary_search(shifted.begin(), shifted.end(), facet[k])) continue;
          vertices(0, facet[k]) += (signs >> (2 * k) & 1) ? amplitude : -amplitude;
          vertices(1, facet[k]) += (signs >> (2 * k + 1) & 1) ? amplitude : -amplitude;
        }
        if (!nonconvex_facets(mesh, vertices).empty()) return true;
      }
    }
    return false;
  };
  EXPECT_FALSE(spoiled(safe * (1 - 1e-3)));
  EXPECT_TRUE(spoiled(safe * (1 + 1e-3)));
}

}  // namespace
}  // namespace misalign::solver
