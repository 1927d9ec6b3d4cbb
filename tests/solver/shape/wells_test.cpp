// Shapes with places, panels' middles, wells of the energy and floors, each checked by vertices
// alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "../blocks.hpp"
#include "solver/contact/contact.hpp"
#include "solver/shape/shape.hpp"

namespace misalign::solver {
namespace {

constexpr double kSixWide_mm = 480;

struct SixBySix {
  SixBySix()
      : sheets(6, 6), model(sheets.base, all_vertices(sheets.base.sheet), {}, 0), solver(model) {
    options.keeping.shifted = all_vertices(sheets.base.sheet);
  }
  const DrawableSheet sheets;
  const Model model;
  SheetSolver solver;
  ShapeOptions options;
};

// Lengths of the diagonals between these vertices, folded or flat.
template <class Vertices>
Eigen::VectorXd lengths_between(const Vertices& vertices_mm, const Sheet& sheet) {
  const auto& diagonals = sheet.mechanism().diagonals;
  Eigen::VectorXd mm(std::ssize(diagonals));
  for (std::size_t d = 0; d < diagonals.size(); ++d) {
    mm(static_cast<Eigen::Index>(d)) =
        (vertices_mm.col(diagonals[d].from) - vertices_mm.col(diagonals[d].to)).norm();
  }
  return mm;
}

Eigen::VectorXd lengths_mm(const Sheet& sheet, double pilot_deg) {
  return lengths_between(sheet.at(pilot_deg).vertices_mm, sheet);
}
Eigen::VectorXd flat_lengths_mm(const Sheet& sheet) {
  return lengths_between(sheet.vertices_mm(), sheet);
}

// Places of a dome's vertices, in another frame: the sheet that has them is known to exist.
TEST(ShapeOfPlaces, IsFoundInAnotherFrame) {
  SixBySix dome;
  dome.options.kind = ShapeKind::free;
  dome.options.target.surface = sphere(3 * kSixWide_mm);
  const auto known = shape(dome.solver, dome.options);
  ASSERT_TRUE(known);
  const Sheet sheet(dome.solver, known->shifts_mm);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  dome.options.target.surface = nullptr;
  for (int v = 0; v < sheet.vertices_mm().cols(); v += 3) {
    dome.options.target.places.push_back(
        {v, turn * sheet.at(dome.options.at_deg).vertices_mm.col(v) + Eigen::Vector3d(7, 300, -5)});
  }
  const auto found = shape(dome.solver, dome.options);
  ASSERT_TRUE(found);
  const Sheet again(dome.solver, found->shifts_mm);
  const Eigen::Matrix3Xd placed_mm = found->pose.placed(again.at(dome.options.at_deg).vertices_mm);
  double largest_mm = 0;
  for (const auto& place : dome.options.target.places) {
    largest_mm = std::max(largest_mm, (placed_mm.col(place.vertex) - place.mm).norm());
  }
  EXPECT_NEAR(largest_mm, found->max_mm, 1e-9);
  EXPECT_LT(largest_mm, 0.05) << "of shifts of " << known->shifts_mm.cwiseAbs().maxCoeff();
}

TEST(ShapeOfPanels, HasTheirMiddlesOnTheSurface) {
  SixBySix saddle_sheet;
  saddle_sheet.options.kind = ShapeKind::free;
  saddle_sheet.options.target.surface = saddle(5 * kSixWide_mm);
  saddle_sheet.options.target.measured = WantedShape::Measured::panels;
  const auto found = shape(saddle_sheet.solver, saddle_sheet.options);
  ASSERT_TRUE(found);
  const Sheet sheet(saddle_sheet.solver, found->shifts_mm);
  const Eigen::Matrix3Xd placed_mm =
      found->pose.placed(sheet.at(saddle_sheet.options.at_deg).vertices_mm);
  const PerforatedSheet& base = saddle_sheet.model.base();
  double largest_mm = 0;
  Eigen::Index panel = 0;
  for (int f = 0; f < base.sheet.facet_count(); ++f) {
    if (std::ranges::find(base.holes, f) != base.holes.end()) continue;
    Eigen::Vector3d middle_mm = Eigen::Vector3d::Zero();
    for (const int v : base.sheet.facets[static_cast<std::size_t>(f)]) {
      middle_mm += placed_mm.col(v) / 4;
    }
    const double up_mm =
        (middle_mm.x() * middle_mm.x() - middle_mm.y() * middle_mm.y()) / (10 * kSixWide_mm);
    // A panel that the rim cuts has its middle beside the sheet's.
    const double level_mm = found->sides(panel++) * found->pose.half_depth_mm;
    largest_mm = std::max(largest_mm, std::abs(middle_mm.z() - up_mm - level_mm));
  }
  EXPECT_LT(found->max_mm, 1e-4 * kSixWide_mm);
  // Heights are distances but for the cosine of a slope of 0.1, of levels of 6 mm.
  EXPECT_NEAR(largest_mm, found->max_mm, 0.03);
}

TEST(BistableShape, HasEqualDiagonalsAndABarrier) {
  SixBySix sheets;
  sheets.options.kind = ShapeKind::bistable;
  sheets.options.target.surface = saddle(3 * kSixWide_mm);
  sheets.options.from_deg = 99;
  sheets.options.barrier_mm = 1;
  const auto found = shape(sheets.solver, sheets.options);
  ASSERT_TRUE(found);
  EXPECT_LT(found->rms_mm, 5e-5 * kSixWide_mm);
  const Sheet sheet(sheets.solver, found->shifts_mm);
  const Eigen::VectorXd flat_mm = flat_lengths_mm(sheet);
  // Programs leave a millionth of their rows' limits, 0.003 mm and the barrier.
  EXPECT_LT((lengths_mm(sheet, sheets.options.at_deg) - flat_mm).cwiseAbs().maxCoeff(), 0.0031);
  EXPECT_GT((lengths_mm(sheet, 60) - flat_mm).norm(), 0.999);
  EXPECT_GT((lengths_mm(sheet, 99) - flat_mm).norm(), 0.999);
}

TEST(ShapeByEnergy, FallsToTheShapeFromBothSides) {
  SixBySix sheets;
  sheets.options.kind = ShapeKind::rest_by_energy;
  sheets.options.target.surface = sphere(3 * kSixWide_mm);
  sheets.options.from_deg = 108;
  const auto found = shape(sheets.solver, sheets.options);
  ASSERT_TRUE(found);
  EXPECT_LT(found->rms_mm, 5e-5 * kSixWide_mm);
  EXPECT_EQ(found->driven_from_deg, 108);
  const Sheet sheet(sheets.solver, found->shifts_mm);
  const Eigen::VectorXd rest_mm = lengths_mm(sheet, 90);
  double last = (flat_lengths_mm(sheet) - rest_mm).norm();
  for (double angle_deg = 4; angle_deg <= 108; angle_deg += 2) {
    const double now = (lengths_mm(sheet, angle_deg) - rest_mm).norm();
    EXPECT_GT(angle_deg <= 90 ? last : now, angle_deg <= 90 ? now : last) << angle_deg;
    last = now;
  }
}

TEST(ShapeWithFloors, KeepsPanelsApart) {
  SixBySix sheets;
  sheets.options.target.surface = sphere(3 * kSixWide_mm);
  sheets.options.from_deg = 108;
  sheets.options.keeping.floors = {{goal_named("thickness_mm"), 3}};
  const auto found = shape(sheets.solver, sheets.options);
  ASSERT_TRUE(found);
  const Sheet sheet(sheets.solver, found->shifts_mm);
  const auto contacts = contact(sheet, {});
  ASSERT_TRUE(contacts && contacts->thickness);
  // Plates of 1.7 mm fit without the floor.
  EXPECT_GT(contacts->thickness->thickness_mm, 2.99);
  EXPECT_LT(found->rms_mm, 5e-5 * kSixWide_mm);
}

}  // namespace
}  // namespace misalign::solver
