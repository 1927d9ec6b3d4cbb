#include "solver/shape/shape.hpp"

#include <gtest/gtest.h>

#include <random>

#include "../blocks.hpp"
#include "solver/target/shape_measure.hpp"

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

// Random shifts of up to `most_mm` at each vertex.
Eigen::Matrix2Xd random_shifts_mm(double most_mm, unsigned seed) {
  std::mt19937 words(seed);
  std::uniform_real_distribution<double> uniform(-most_mm, most_mm);
  return Eigen::Matrix2Xd(2, 49).unaryExpr([&](double) { return uniform(words); });
}

// The heavier the weight, the nearer to its start it ends; and it has the shape all the same.
TEST(Shape, StaysBesideItsStart) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    double last_mm = 1e9;
    for (const double weight : {0.003, 0.03, 0.1}) {
      Shaped dome(sphere(3 * kSheetWidth_mm), 105);
      dome.options.start_mm = random_shifts_mm(3, seed);
      dome.options.shift_weight = weight;
      const auto found = shape(dome.solver, dome.options);
      ASSERT_TRUE(found);
      const double moved_mm = (found->shifts_mm - *dome.options.start_mm).norm();
      EXPECT_LT(moved_mm, last_mm) << weight;
      EXPECT_LT(found->rms_mm, 1e-3 * kSheetWidth_mm);
      last_mm = moved_mm;
    }
  }
}

TEST(Shape, BeginsAtTheBaseUnlessAskedToBeginElsewhere) {
  Shaped dome(sphere(3 * kSheetWidth_mm), 105);
  const auto of_base = shape(dome.solver, dome.options);
  dome.options.start_mm = Eigen::Matrix2Xd::Zero(2, 49);
  const auto of_zero = shape(dome.solver, dome.options);
  dome.options.start_mm = random_shifts_mm(3, 4);
  const auto of_others = shape(dome.solver, dome.options);
  ASSERT_TRUE(of_base && of_zero && of_others);
  EXPECT_EQ(of_base->shifts_mm, of_zero->shifts_mm);
  EXPECT_GT((of_base->shifts_mm - of_others->shifts_mm).cwiseAbs().maxCoeff(), 1);
}

// A diagonal changes against its direction, another as before.
TEST(Shape, TurnsADiagonal) {
  Shaped twist(helicoid(10 * kSheetWidth_mm), 120);
  const auto change_mm = [&](const ShapeStudy& study, int diagonal) {
    const Sheet sheet(twist.solver, study.shifts_mm);
    return sheet.at(100).length_mm(diagonal) - sheet.way()->flat_mm()(diagonal);
  };
  const auto plain = shape(twist.solver, twist.options);
  ASSERT_TRUE(plain);
  twist.options.turned = {3};
  const auto turned = shape(twist.solver, twist.options);
  ASSERT_TRUE(turned);
  EXPECT_LT(change_mm(*plain, 3) * change_mm(*turned, 3), 0);
  EXPECT_GT(change_mm(*plain, 5) * change_mm(*turned, 5), 0);
}

// Any sheet is measured in its best pose, which the descent found by its own way, as the curvature
// grew: also where the surface is tight.
TEST(Shape, IsMeasuredAsTheDescentFoundIt) {
  const double width_mm = kSheetWidth_mm;
  for (const auto& surface : {sphere(3 * width_mm), helicoid(1.5 * width_mm), saddle(5 * width_mm),
                              sphere(1.5 * width_mm), saddle(-1.5 * width_mm)}) {
    Shaped shaped(surface->scaled(1), 105);
    shaped.options.kind = ShapeKind::free;
    const auto found = shape(shaped.solver, shaped.options);
    ASSERT_TRUE(found);
    const Sheet sheet(shaped.solver, found->shifts_mm);
    const auto off = shape_misfit_of(sheet, shaped.options.target, shaped.options.at_deg);
    ASSERT_TRUE(off);
    EXPECT_NEAR(off->rms_mm(), found->rms_mm, 1e-6 * found->rms_mm);
    EXPECT_NEAR(off->max_mm(), found->max_mm, 1e-5 * found->max_mm);
  }
}

}  // namespace
}  // namespace misalign::solver
