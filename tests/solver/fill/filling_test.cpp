// Fillings of whole sheets against springs and plates that are added up one by one.
#include "solver/fill/filling.hpp"

#include <gtest/gtest.h>

#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

struct Table1Filling : testing::Test {
  Table1Filling() {
    holes.flat_mm = way.flat_mm();
    way.find_lengths(way.x_of(20), holes.rest_mm, rates);
    way.find_lengths(way.x_of(90), folded_mm, rates);
    holes.sides = (folded_mm - holes.flat_mm).cwiseSign();
    holes.product_mm2 = diagonal_products_mm2(sheet.mechanism, vertices_mm);
  }

  Filling filling(const Fill& fill) const { return {fill, sheet.mechanism.diagonals, holes}; }

  const TestSheet sheet{6, 6};
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json")["displacements_mm"]);
  const OwnSheet own{sheet.base, vertices_mm - sheet.base.sheet.vertices_mm};
  const FoldingWay& way = *own.sheet.way();
  HoleDiagonals holes;
  VectorXd folded_mm, rates;
};

TEST_F(Table1Filling, ProductsOfDiagonalsStayAsTheyAre) {
  for (const double deg : {1.0, 36.0, 90.0, 156.0}) {
    const Eigen::Matrix3Xd& at_mm = own.sheet.at(deg).vertices_mm;
    for (Index h = 0; h < holes.product_mm2.size(); ++h) {
      const Diagonal &one = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * h)],
                     &other = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * h + 1)];
      const double product = (at_mm.col(one.to) - at_mm.col(one.from))
                                 .dot(at_mm.col(other.to) - at_mm.col(other.from));
      EXPECT_NEAR(product, holes.product_mm2(h), 1e-8) << deg << " " << h;
    }
  }
}

// Every kind of spring at once: with a preload, with a rate of its own, with a free length of its
// own, and none.
TEST_F(Table1Filling, SpringsPullByTheirOwnRatesAndLengths) {
  const auto& diagonals = sheet.mechanism.diagonals;
  Springs springs;
  springs.stiffness_n_per_mm = 20;
  springs.preload.each_n = 3;
  springs.preload.others = {{diagonals[2].to, diagonals[2].from, 5}};
  springs.single = {{diagonals[4].from, diagonals[4].to, 7, 100.0},
                    {diagonals[5].to, diagonals[5].from, 8, {}},
                    {diagonals[6].from, diagonals[6].to, 0, {}}};
  for (const bool pull_only : {false, true}) {
    springs.pull_only = pull_only;
    const Filling filling = this->filling(springs);
    ASSERT_TRUE(filling.is_springs());
    const VectorXd forces_n = filling.forces_n(folded_mm);
    const Eigen::MatrixXd stiffness = filling.stiffness_n_per_mm(folded_mm);
    double energy = 0;
    int slack = 0;
    for (Index d = 0; d < folded_mm.size(); ++d) {
      const double rate = d == 4 ? 7 : d == 5 ? 8 : d == 6 ? 0 : 20;
      // A diagonal that lengthens is pulled by its preload, one that shortens is pushed.
      const double preload_n = (d == 2 ? 5 : 3) * holes.sides(d);
      double force_n = preload_n + rate * (folded_mm(d) - holes.rest_mm(d));
      if (d == 4) force_n = 7 * (folded_mm(d) - 100);
      if (d == 6 || (pull_only && force_n < 0)) force_n = 0;
      slack += force_n == 0;
      EXPECT_NEAR(forces_n(d), force_n, 1e-10) << d;
      EXPECT_EQ(stiffness(d, d), force_n == 0 ? 0 : rate) << d;
      if (rate > 0) energy += force_n * force_n / (2 * rate);
    }
    EXPECT_EQ(slack > 1, pull_only);
    EXPECT_NEAR(filling.energy_n_mm(folded_mm), energy, 1e-10 * energy);
    EXPECT_EQ(stiffness.diagonal().sum(), stiffness.sum());
  }
}

// Each plate is that of the corners' coordinates on the folded sheet: stress-free are the hole at
// rest over the pre-stretch, and one cut-out of its own.
TEST_F(Table1Filling, PlatesAreThoseOfTheirHoles) {
  RubberPlates plates{0.4, 1.5, 1.1, 20, {}};
  plates.cut_outs = {{.hole = 3, .of_flat = {0.9, 0.95}}};
  const Filling filling = this->filling(plates);
  ASSERT_FALSE(filling.is_springs());
  const auto shape = [&](const Eigen::Matrix3Xd& at_mm, Index h, double one, double other) {
    const Diagonal &a = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * h)],
                   &b = sheet.mechanism.diagonals[static_cast<std::size_t>(2 * h + 1)];
    const Eigen::Vector3d first = one * (at_mm.col(a.to) - at_mm.col(a.from)),
                          second = other * (at_mm.col(b.to) - at_mm.col(b.from));
    return HoleShape{first.squaredNorm(), second.squaredNorm(), first.dot(second)};
  };
  Eigen::Matrix3Xd flat_mm = Eigen::Matrix3Xd::Zero(3, vertices_mm.cols());
  flat_mm.topRows<2>() = vertices_mm;
  double energy = 0;
  for (Index h = 0; h < filling.holes(); ++h) {
    const HoleShape rest = h == 3 ? shape(flat_mm, h, 0.9, 0.95)
                                  : shape(own.sheet.at(20).vertices_mm, h, 1 / 1.1, 1 / 1.1);
    const HoleShape now = shape(own.sheet.at(90).vertices_mm, h, 1, 1);
    const Vector2d lengths_mm(std::sqrt(now.first_mm2), std::sqrt(now.second_mm2));
    const HoleEnergy plate = PlateLaw(0.6, rest).at(lengths_mm, now.product_mm2);
    energy += plate.n_mm;
    // Ends of a cut-out with other ratios: its angle stays that of the flat hole.
    EXPECT_LT((filling.forces_n(folded_mm).segment<2>(2 * h) - plate.force_n).norm(), 1e-8) << h;
  }
  EXPECT_NEAR(filling.energy_n_mm(folded_mm), energy, 1e-9 * energy);
  EXPECT_GT(energy, 100);
}

TEST_F(Table1Filling, NothingHasNoEnergy) {
  const Filling filling = this->filling(NoFill{});
  EXPECT_EQ(filling.energy_n_mm(folded_mm), 0);
  EXPECT_EQ(filling.forces_n(folded_mm), VectorXd::Zero(folded_mm.size()));
}

}  // namespace
}  // namespace misalign::solver
