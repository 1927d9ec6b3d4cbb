// The springs' motion, beside panels that are placed by their four corners (Kabsch), and beside the
// lengths of diagonals that loops give.
#include "schema/kit/kit_springs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

std::vector<KitSpring> springs_of(const KitFixture& kit, SpringAt at) {
  KitOptions options;
  options.spring_bore_mm = 1.5;
  options.spring_at = at;
  return kit_springs(kit.sheet, kit_fittings(kit.sheet, options), kit.sheet.rows_shown());
}

// A point of a panel where a shape has it: by the turn and shift that put four corners on four.
Eigen::Vector3d placed(const KitFixture& kit, const SpringEnd& end, const Eigen::Matrix3Xd& shape) {
  Eigen::Matrix<double, 3, 4> flat = Eigen::Matrix<double, 3, 4>::Zero(), folded;
  for (int k = 0; k < 4; ++k) {
    const int v =
        kit.base.sheet.facets[static_cast<std::size_t>(end.facet)][static_cast<std::size_t>(k)];
    flat.col(k).head<2>() = kit.vertices_mm.col(v);
    folded.col(k) = shape.col(v);
  }
  const Eigen::Isometry3d moved(Eigen::umeyama(flat, folded, false));
  return moved * Eigen::Vector3d(end.at_mm.x(), end.at_mm.y(), 0);
}

TEST(KitSprings, AreAsLongAsThePanelsOfTheirEndsHaveIt) {
  for (const auto& [rows, columns] : {std::pair(4, 4), std::pair(6, 8)}) {
    const KitFixture kit(rows, columns);
    const auto shown = kit.sheet.rows_shown();
    ASSERT_GT(shown, 0);
    const auto springs = springs_of(kit, SpringAt::panel);
    ASSERT_EQ(springs.size(), kit.mechanism.diagonals.size());
    for (const KitSpring& spring : springs) {
      ASSERT_EQ(static_cast<Eigen::Index>(spring.length_mm.size()), shown + 1);
      double least = spring.length_mm[0], most = least;
      for (Eigen::Index row = 0; row < shown; ++row) {
        const auto& shape = kit.sheet.shapes_mm()[static_cast<std::size_t>(row)];
        const double length =
            (placed(kit, spring.from, shape) - placed(kit, spring.to, shape)).norm();
        EXPECT_NEAR(spring.length_mm[static_cast<std::size_t>(row) + 1], length, 1e-7);
        least = std::min(least, length);
        most = std::max(most, length);
      }
      EXPECT_NEAR(spring.stroke_mm(), most - least, 1e-7);
    }
  }
}

TEST(KitSprings, OnVerticesDoWhatTheirDiagonalsDo) {
  const KitFixture kit(6, 6);
  const auto springs = springs_of(kit, SpringAt::vertex);
  for (std::size_t d = 0; d < springs.size(); ++d) {
    const KitSpring& spring = springs[d];
    EXPECT_NEAR(spring.length_mm[0], kit.sheet.history().flat_mm[d], 1e-9);
    for (std::size_t row = 0; row + 1 < spring.length_mm.size(); ++row) {
      EXPECT_NEAR(spring.length_mm[row + 1],
                  kit.sheet.history().length_mm(static_cast<Eigen::Index>(row),
                                                static_cast<Eigen::Index>(d)),
                  1e-7);
    }
    EXPECT_EQ(spring.trend, spring.diagonal_trend);
  }
  EXPECT_EQ(contradiction_of(springs), "");
}

// Diagonals of a correct Miura-ori keep their lengths; between bores in panels something changes.
TEST(KitSprings, BoresInPanelsDriveASheetWhoseDiagonalsDoNothing) {
  const KitFixture kit(4, 4, "checkerboard-odd", 0);
  for (const KitSpring& spring : springs_of(kit, SpringAt::vertex)) {
    EXPECT_EQ(spring.trend, LengthTrend::constant);
  }
  const auto springs = springs_of(kit, SpringAt::panel);
  int driven = 0;
  for (const KitSpring& spring : springs) {
    EXPECT_EQ(spring.diagonal_trend, LengthTrend::constant);
    driven += spring.stroke_mm() > 1;
  }
  EXPECT_GT(driven, 0);
  EXPECT_EQ(contradiction_of(springs).find(std::to_string(driven) + " of 4 springs contradict"), 0u)
      << contradiction_of(springs);
}

TEST(KitSprings, AContradictionNamesItsKinds) {
  const auto spring = [](std::vector<double> length_mm, LengthTrend trend, LengthTrend diagonal) {
    const SpringEnd end{0, 0, 0, {0, 0}, 0};
    return KitSpring{end, end, std::move(length_mm), {}, trend, diagonal};
  };
  using enum LengthTrend;
  const std::vector<KitSpring> springs = {
      spring({1, 2}, lengthens, lengthens), spring({2, 1}, shortens, lengthens),
      spring({2, 1}, shortens, lengthens),  spring({1, 2, 1}, reverses, shortens),
      spring({1, 2}, lengthens, constant),  spring({1, 1}, constant, lengthens),
      spring({1, 2}, lengthens, reverses)};
  const std::string words = contradiction_of(springs);
  EXPECT_EQ(words.find("5 of 7 springs contradict the verdict (2 oppose their diagonals"), 0u)
      << words;
  for (const char* kind : {"1 reverses", "1 keeps its length", "1 changes its length though"}) {
    EXPECT_NE(words.find(kind), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace misalign::schema
