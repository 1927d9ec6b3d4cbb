#include "solver/perforation.hpp"

#include "sheets.hpp"

namespace misalign::solver {
namespace {

TEST(Perforation, CheckerboardsOfThePaper) {
  const CreasePattern paper = miura_sheet(MiuraShape::uniform(6, 6, 80, 80, 40));
  EXPECT_EQ(checkerboard(paper, 1), (std::vector<int>{8, 10, 13, 15, 20, 22, 25, 27}));
  EXPECT_EQ(checkerboard(paper, 0), (std::vector<int>{7, 9, 14, 16, 19, 21, 26, 28}));
  // A9 and A41 stay whole with the odd one, A13 and A37 with the even one.
  for (const auto& [holes, whole] :
       {std::pair{"checkerboard-odd", std::vector<int>{8, 40}}, {"checkerboard-even", {12, 36}}}) {
    const TestSheet sheet(6, 6, holes);
    std::vector<int> found;
    for (const Loop& loop : sheet.mechanism.loops) {
      if (loop.rows == 3) found.push_back(loop.passages[0].vertex);
    }
    EXPECT_EQ(found, whole);
  }
}

// model.md: with an odd side counting is right and the rank is not.
TEST(Perforation, RankOfTheBaseSheet) {
  struct Sheet {
    int rows, columns, rank, equations;
  };
  for (const Sheet& c : {Sheet{4, 4, 18, 18}, Sheet{6, 6, 54, 54}, Sheet{8, 6, 78, 78},
                         Sheet{3, 4, 11, 12}, Sheet{5, 6, 40, 42}, Sheet{7, 6, 64, 66}}) {
    for (const char* holes : {"checkerboard-odd", "checkerboard-even"}) {
      const TestSheet sheet(c.rows, c.columns, holes);
      const Mobility mobility =
          measured_mobility(sheet.base.sheet, sheet.base.holes, sheet.base.folding);
      EXPECT_EQ(mobility.rank, c.rank) << c.rows << " x " << c.columns << " " << holes;
      EXPECT_EQ(mobility.equations, c.equations);
      EXPECT_EQ(counted_mobility(sheet.base.sheet, sheet.base.holes), 1);
    }
  }
}

TEST(Perforation, HolesThatCannotBe) {
  const TestSheet sheet(6, 6);
  EXPECT_TRUE(hole_faults(sheet.base.sheet, sheet.base.holes).empty());
  EXPECT_EQ(hole_faults(sheet.base.sheet, {0}).size(), 1u);      // a corner panel
  EXPECT_EQ(hole_faults(sheet.base.sheet, {7, 8}).size(), 1u);   // side by side
  EXPECT_EQ(hole_faults(sheet.base.sheet, {7, 13}).size(), 1u);  // one above the other
  EXPECT_EQ(hole_faults(sheet.base.sheet, {7, 14}).size(), 0u);  // meeting at a corner
  EXPECT_EQ(hole_faults(sheet.base.sheet, {5, 11}).size(), 3u);  // on the border and side by side
}

}  // namespace
}  // namespace misalign::solver
