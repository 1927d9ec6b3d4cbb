#include "solver/shape/shape.hpp"

#include <gtest/gtest.h>

#include "../blocks.hpp"

namespace misalign::solver {
namespace {

// A study of a Miura sheet, its target given by its radius in widths of the sheet.
struct Shaped {
  explicit Shaped(std::shared_ptr<const TargetSurface> target, double from_deg)
      : sheets(6, 6), model(sheets.base, all_vertices(sheets.base.sheet), {}, 0), solver(model) {
    options.target.surface = std::move(target);
    options.from_deg = from_deg;
  }
  const DrawableSheet sheets;
  const Model model;
  SheetSolver solver;
  ShapeOptions options;
};

constexpr double kSheetWidth_mm = 480;

// Checked without the study's code: panels keep the lengths of their sides and diagonals, and
// vertices lie at the half depth from a sphere whose centre is known.
TEST(Shape, IsADomeOfRigidPanels) {
  Shaped dome(sphere(3 * kSheetWidth_mm), 108);
  const auto found = shape(dome.solver, dome.options);
  ASSERT_TRUE(found);
  const Sheet sheet(dome.solver, found->shifts_mm);
  const Eigen::Matrix3Xd& folded_mm = sheet.at(dome.options.at_deg).vertices_mm;
  const CreasePattern& pattern = dome.model.base().sheet;
  const std::vector<int>& holes = dome.model.base().holes;
  for (int f = 0; f < pattern.facet_count(); ++f) {
    if (std::ranges::find(holes, f) != holes.end()) continue;
    const auto& corners = pattern.facets[static_cast<std::size_t>(f)];
    for (const auto& [a, b] :
         {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2), std::pair(1, 3)}) {
      const double flat_mm = (sheet.point_mm(corners[a]) - sheet.point_mm(corners[b])).norm(),
                   there_mm = (folded_mm.col(corners[a]) - folded_mm.col(corners[b])).norm();
      EXPECT_NEAR(flat_mm, there_mm, 1e-8);
    }
  }
  const Eigen::Matrix3Xd placed_mm = found->pose.placed(folded_mm);
  double squares = 0;
  for (Eigen::Index v = 0; v < placed_mm.cols(); ++v) {
    const double away_mm = (placed_mm.col(v) + Eigen::Vector3d(0, 0, 3 * kSheetWidth_mm)).norm() -
                           3 * kSheetWidth_mm - found->sides(v) * found->pose.half_depth_mm;
    squares += away_mm * away_mm;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(placed_mm.cols())), found->rms_mm, 1e-9);
  EXPECT_LT(found->rms_mm, 5e-5 * kSheetWidth_mm) << "the largest of a prototype's domes";
  EXPECT_GE(sheet.deploys_from_deg(), 108) << "all diagonals are monotone";
}

// An arch across needs almost no shift: 0.6 mm are known for a radius of five widths.
TEST(Shape, IsAnArchWithSmallShifts) {
  Shaped arch(cylinder(5 * kSheetWidth_mm, false), 150);
  const auto found = shape(arch.solver, arch.options);
  ASSERT_TRUE(found);
  EXPECT_LT(found->rms_mm, 2e-5 * kSheetWidth_mm);
  EXPECT_LT(found->shifts_mm.cwiseAbs().maxCoeff(), 1.2);
  EXPECT_GE(found->deploys_from_deg, 150);
}

TEST(Shape, KeepsTheRimAndTheAmplitude) {
  Shaped twist(helicoid(10 * kSheetWidth_mm), 120);
  twist.options.kind = ShapeKind::free;
  twist.options.is_rim_fixed = true;
  twist.options.amplitude_mm = 1.5;
  const auto found = shape(twist.solver, twist.options);
  ASSERT_TRUE(found);
  EXPECT_LE(found->shifts_mm.cwiseAbs().maxCoeff(), 1.5);
  const std::vector<int> inner = interior_vertices(twist.model.base().sheet);
  for (int v = 0; v < twist.model.base().sheet.vertex_count(); ++v) {
    const bool is_inner = std::ranges::find(inner, v) != inner.end();
    EXPECT_TRUE(is_inner || found->shifts_mm.col(v).norm() == 0) << v;
  }
  EXPECT_GT(found->steps, 0);
}

}  // namespace
}  // namespace misalign::solver
