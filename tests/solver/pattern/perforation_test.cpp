#include "solver/pattern/perforation.hpp"

#include <Eigen/Eigenvalues>
#include <random>
#include <set>

#include "solver/linear/mobility.hpp"
#include "tests/solver/sheets.hpp"

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

// Against singular values of the dense Jacobian: perforations with a hole more or less, or with
// few, on sheets of all kinds of sides.
TEST(Perforation, RankAgainstSingularValues) {
  std::mt19937 words(3);
  for (const auto& [rows, columns] : {std::pair(3, 4), {5, 5}, {6, 6}, {7, 6}, {8, 8}, {9, 8}}) {
    TestSheet sheet(rows, columns);
    const std::vector<int> all = sheet.base.holes;
    for (std::size_t left_out : {std::size_t{0}, std::size_t{1}, all.size() / 2, all.size() - 1}) {
      std::vector<int> holes = all;
      for (; left_out > 0; --left_out) holes.erase(holes.begin() + words() % holes.size());
      const Mechanism mechanism = build_mechanism({sheet.base.sheet, holes, sheet.base.folding});
      ClosureSystem system(mechanism);
      int rank = 0;
      for (const double pilot_deg : {40.0, 75.0, 110.0}) {
        system.evaluate(sheet.geometry,
                        base_state(mechanism, sheet.base.folding, sheet.base.sheet.vertices_mm,
                                   half_angle_of_deg(pilot_deg)));
        // Singular values above 1e-5: their squares, known to 1e-14 of the largest, above 1e-10.
        const Eigen::MatrixXd& jacobian = system.jacobian();
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(
            jacobian * jacobian.transpose(), Eigen::EigenvaluesOnly);
        rank = std::max(rank, static_cast<int>((squares.eigenvalues().array() > 1e-10).count()));
      }
      EXPECT_EQ(measured_mobility(sheet.base.sheet, holes, sheet.base.folding).rank, rank)
          << rows << " x " << columns << " with " << holes.size() << " holes";
    }
  }
}

// By dense matrices these took minutes each. The ranks are those that dense QR with column pivoting
// gave.
TEST(Perforation, RankOfLargeSheets) {
  for (const auto& [rows, columns, rank] :
       {std::tuple(20, 20, 978), {39, 40, 4205}, {40, 40, 4338}}) {
    const TestSheet sheet(rows, columns);
    EXPECT_EQ(measured_mobility(sheet.base.sheet, sheet.base.holes, sheet.base.folding).rank, rank);
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

// All subsets of the inner facets, one by one: of the right size, and without fault.
TEST(Perforation, SeparateFacetsAgainstAllSubsets) {
  for (int rows = 3; rows <= 6; ++rows) {
    for (int columns = 3; columns <= 6; ++columns) {
      const CreasePattern sheet = miura_sheet(MiuraShape::uniform(rows, columns, 80, 80, 40));
      const std::vector<int> inner = inner_facets(sheet);
      std::vector<std::set<std::vector<int>>> expected(inner.size() + 2);  // by size
      for (unsigned subset = 0; subset < 1u << inner.size(); ++subset) {
        std::vector<int> holes;
        for (std::size_t i = 0; i < inner.size(); ++i) {
          if (subset >> i & 1) holes.push_back(inner[i]);
        }
        // Side by side or one above the other, by their places alone.
        const bool apart = std::none_of(holes.begin(), holes.end(), [&](int f) {
          return std::any_of(holes.begin(), holes.end(), [&](int g) {
            return std::abs(sheet.places[f][0] - sheet.places[g][0]) +
                       std::abs(sheet.places[f][1] - sheet.places[g][1]) ==
                   1;
          });
        });
        if (apart) expected[holes.size()].insert(holes);
      }
      for (int count = 0; count < static_cast<int>(expected.size()); ++count) {
        const auto found = separate_facets(sheet, count, 10000);
        ASSERT_TRUE(found);
        EXPECT_TRUE(std::is_sorted(found->begin(), found->end()));
        EXPECT_EQ(found->size(), expected[count].size()) << rows << " x " << columns;
        EXPECT_EQ(std::set(found->begin(), found->end()), expected[count]);
        for (const auto& holes : *found) EXPECT_TRUE(hole_faults(sheet, holes).empty());
      }
      // (2.1) is 1 - (m - 2)(n - 2), and each hole gives 2.
      const int lacking = (rows - 2) * (columns - 2);
      EXPECT_EQ(holes_that_count_to_one(sheet), lacking % 2 == 0 ? lacking / 2 : -1);
    }
  }
}

TEST(Perforation, SeparateFacetsOfLargeSheets) {
  const auto sheet = [](int rows, int columns) {
    return miura_sheet(MiuraShape::uniform(rows, columns, 80, 80, 40));
  };
  // With even sides every two neighbours have exactly one hole: the two checkerboards remain.
  const CreasePattern large = sheet(40, 40);
  const auto found = separate_facets(large, holes_that_count_to_one(large), 10);
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, (std::vector{checkerboard(large, 0), checkerboard(large, 1)}));
  // In one row of 2k inner panels k + 1 sets: one place where the step from hole to hole is 3.
  EXPECT_EQ(separate_facets(sheet(3, 40), 19, 100)->size(), 20u);
  // Fewer holes than fit are too many sets, which is said in time.
  EXPECT_FALSE(separate_facets(large, 100, 1000));
  EXPECT_FALSE(separate_facets(sheet(6, 6), 4, 10));
  EXPECT_TRUE(separate_facets(large, -1, 10)->empty());
}

// No perforation of a Miura-ori with an odd side has mobility 1.
TEST(Perforation, OddSidesHaveNone) {
  for (const auto& [rows, columns] : {std::pair(3, 4), {3, 6}, {3, 8}, {4, 5}, {5, 6}, {6, 5}}) {
    const TestSheet sheet(rows, columns);
    const auto sets =
        separate_facets(sheet.base.sheet, holes_that_count_to_one(sheet.base.sheet), 100);
    ASSERT_TRUE(sets);
    EXPECT_GE(sets->size(), 2u);
    for (const auto& holes : *sets) {
      EXPECT_EQ(counted_mobility(sheet.base.sheet, holes), 1);
      EXPECT_FALSE(measured_mobility(sheet.base.sheet, holes, sheet.base.folding).is_one());
    }
  }
}

// Coordinates written to 1e-4 mm give a sheet that lacks rank none back.
TEST(Perforation, RankOfRoundedCoordinates) {
  for (const auto& [rows, columns] : {std::pair(3, 4), {5, 6}, {4, 4}, {6, 6}}) {
    TestSheet sheet(rows, columns);
    const auto exact = measured_mobility(sheet.base.sheet, sheet.base.holes, sheet.base.folding);
    std::mt19937 words(5);
    for (double& x : sheet.base.sheet.vertices_mm.reshaped()) {
      x += 1e-4 * (std::generate_canonical<double, 53>(words) - 0.5);
    }
    const auto rounded = measured_mobility(sheet.base.sheet, sheet.base.holes, sheet.base.folding);
    EXPECT_EQ(rounded.rank, exact.rank) << rows << " x " << columns;
  }
}

}  // namespace
}  // namespace misalign::solver
