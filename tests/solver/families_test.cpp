// Every family of base patterns: its folding found again by other means.
#include "families.hpp"
#include "vertex_coordinates.hpp"

namespace misalign::solver {
namespace {

constexpr int kSheets = kFewer > 1 ? 1 : 4;

class Families : public testing::TestWithParam<std::string> {};

// Diagonals of the paths' every tenth degree to 150 (beyond it another branch may be near, see
// SheetFamily) or to the fold limit by the tracker, and from coordinates that start near the base
// folding at 1 degree and know nothing of it afterwards. Closed to 1e-12, lengths are open by 1e-12
// panel widths over the smallest singular value, which is 1e-4 beside a fold limit: 1e-6 mm. But
// the last correction of either solver squares what was left, and 1e-16 does no harm: worst of
// 1,400 paths 2e-11 mm, limit 1e-9.
TEST_P(Families, DiagonalsAreThoseOfVertexCoordinates) {
  const CarriedFamily whole(GetParam());
  double worst_mm = 0;
  for (const CarriedFamily& family : {whole, CarriedFamily(cut_down(whole.base, 4, 4))}) {
    PathPlanOptions options;
    options.sample_deg = 10;
    options.end_deg = std::min(150.0, family.end_deg());
    const PathPlan plan = family.plan(options);
    const FoldedShape shape(family.base.sheet, family.base.holes, family.mechanism);
    const auto start = base_state(family.mechanism, family.base.folding,
                                  family.base.sheet.vertices_mm, half_angle_of_deg(1));
    SheetGeometry<double> geometry;
    const ShiftBlock block = family.draws(kSheets, kSeed);
    for (int i = 0; i < block.sheets; ++i) {
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", sheet " + std::to_string(i));
      const FlatVertices flat_mm = family.vertices(block, i);
      const auto history = record_history(family.base, family.mechanism, plan, flat_mm);
      EXPECT_GE(history.stops.size(), 5u);
      place(family.mechanism, flat_mm, geometry);
      VertexCoordinates coordinates(family.base, flat_mm, shape.vertices_mm(geometry, start), 1);
      for (std::size_t k = 0; k < history.stops.size(); ++k) {
        ASSERT_TRUE(coordinates.fold_to(history.stops[k].pilot_deg));
        for (int d = 0; d < family.mechanism.diagonal_count(); ++d) {
          const Diagonal& diagonal = family.mechanism.diagonals[d];
          const double difference_mm = coordinates.distance_mm(diagonal.from, diagonal.to) -
                                       history.length_mm(static_cast<Eigen::Index>(k), d);
          worst_mm = std::max(worst_mm, std::abs(difference_mm));
        }
      }
    }
  }
  EXPECT_LE(worst_mm, 1e-9);
  RecordProperty("worst_mm", scientific(worst_mm));
}

INSTANTIATE_TEST_SUITE_P(Carried, Families, testing::ValuesIn(carried_families()), family_word);

}  // namespace
}  // namespace misalign::solver
