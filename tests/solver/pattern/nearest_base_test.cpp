// Bases of meshes that do not fold rigidly: rounded ones, and ones that are shifted far.
#include "solver/pattern/nearest_base.hpp"

#include <cmath>
#include <random>

#include "tests/solver/families.hpp"

namespace misalign::solver {
namespace {

// By angles of the C library, of a vertex' opposite sectors: what their sum lacks of 180 degrees.
double kawasaki_defect_deg(const CreasePattern& sheet, int vertex) {
  double sum_deg = -180;
  const std::vector<int> ring = facets_around(sheet, vertex);
  for (std::size_t k = 0; k < ring.size(); k += 2) {
    const auto& corners = sheet.facets[ring[k]];
    const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
    const Eigen::Vector2d out = sheet.vertices_mm.col(corners[(at + 1) % 4]) -
                                sheet.vertices_mm.col(vertex),
                          in = sheet.vertices_mm.col(corners[(at + 3) % 4]) -
                               sheet.vertices_mm.col(vertex);
    sum_deg += std::acos(out.dot(in) / (out.norm() * in.norm())) * 180 / std::acos(-1.0);
  }
  return sum_deg;
}

double largest_defect_deg(const CreasePattern& sheet) {
  double largest = 0;
  for (const int v : interior_vertices(sheet)) {
    largest = std::max(largest, std::abs(kawasaki_defect_deg(sheet, v)));
  }
  return largest;
}

FlatVertices rounded_to(const FlatVertices& vertices_mm, double mm) {
  return (vertices_mm / mm).array().round() * mm;
}

std::optional<NearestBase> base_of(const CreasePattern& sheet, const BaseFolding& like) {
  auto folded = fold_sequentially(sheet, assignment_from_above(like), like.pilot_edge());
  const auto* none = std::get_if<NoBaseFolding>(&folded);
  EXPECT_TRUE(none && none->unclosed);
  return none && none->unclosed ? nearest_base(sheet, *none->unclosed) : std::nullopt;
}

// Sheets that fold are a smooth set, whose nearest point the shortest steps find but for its
// curvature: the sheet that was rounded is one of them, and not nearer.
TEST(NearestBase, OfARoundedMeshIsNoFartherThanTheMeshItWas) {
  for (const char* name : {"angle-array-6x6", "turned-quads-6x6"}) {
    const CarriedFamily family(name);
    const bool folds_flat = largest_defect_deg(family.base.sheet) < 1e-6;
    EXPECT_EQ(folds_flat, family.base.folding.end_deg() == 180) << name;
    for (const double mm : {0.001, 0.01, 0.1}) {
      CreasePattern sheet = family.base.sheet;
      sheet.vertices_mm = rounded_to(sheet.vertices_mm, mm);
      const auto near = base_of(sheet, family.base.folding);
      ASSERT_TRUE(near) << name << mm;
      const double off = (near->sheet.vertices_mm - sheet.vertices_mm).norm(),
                   true_off = (family.base.sheet.vertices_mm - sheet.vertices_mm).norm();
      EXPECT_LT(off, 1.001 * true_off) << name << mm;
      EXPECT_GT(off, 0.1 * true_off) << name << mm;
      EXPECT_GE(near->off_mm * std::sqrt(sheet.vertex_count()), off);
      EXPECT_EQ(near->folding.assignment(), family.base.folding.assignment());
      EXPECT_NEAR(near->folding.end_deg(), family.base.folding.end_deg(), folds_flat ? 0 : 5 * mm);
      // Coordinates end at 1e-9 mm.
      EXPECT_LT(folds_flat ? largest_defect_deg(near->sheet) : 0, 1e-8) << name << mm;
    }
  }
}

TEST(NearestBase, OfASheetShiftedFarFoldsFlatAndKeepsItsLetters) {
  const CarriedFamily miura("table1");
  std::mt19937 words(5);
  for (const double share : {0.02, 0.075}) {
    CreasePattern sheet = miura.base.sheet;
    std::uniform_real_distribution<double> shift_mm(-share * sheet.panel_width_mm,
                                                    share * sheet.panel_width_mm);
    for (double& x : sheet.vertices_mm.reshaped()) x += shift_mm(words);
    ASSERT_TRUE(nonconvex_facets(sheet, sheet.vertices_mm).empty());
    const auto near = base_of(sheet, miura.base.folding);
    ASSERT_TRUE(near) << share;
    EXPECT_LT(largest_defect_deg(near->sheet), 1e-8);
    EXPECT_EQ(near->folding.end_deg(), 180);
    EXPECT_EQ(near->folding.assignment(), miura.base.folding.assignment());
    EXPECT_LT(near->off_mm, 2 * share * sheet.panel_width_mm);
    EXPECT_TRUE(nonconvex_facets(sheet, near->sheet.vertices_mm).empty());
  }
}

}  // namespace
}  // namespace misalign::solver
