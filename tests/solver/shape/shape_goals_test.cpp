// Other goals of a sheet that keeps its shape, and the shape as a goal.
#include "solver/optimise/optimise.hpp"
#include "solver/shape/shape.hpp"
#include "solver/target/shape_measure.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::VectorXd;

constexpr double kDomeRadius_mm = 3 * 320, kDome_deg = 90, kStowed_deg = 105;

// Distances from a sphere and half a depth above or below it, by least squares of its centre and of
// the depth.
VectorXd distances_from_a_dome_mm(const Matrix3Xd& vertices_mm, const VectorXd& sides,
                                  const ShapePose& near) {
  Eigen::Vector3d centre_mm =
      near.turn.transpose() * (Eigen::Vector3d(0, 0, -kDomeRadius_mm) - near.move_mm);
  double depth_mm = near.half_depth_mm;
  VectorXd off_mm(sides.size());
  for (int step = 0; step < 30; ++step) {
    Eigen::MatrixXd slopes(sides.size(), 4);
    for (Index v = 0; v < sides.size(); ++v) {
      const Eigen::Vector3d from_mm = vertices_mm.col(v) - centre_mm;
      off_mm(v) = from_mm.norm() - kDomeRadius_mm - sides(v) * depth_mm;
      slopes.row(v) << -from_mm.normalized().transpose(), -sides(v);
    }
    const Eigen::Vector4d change = -slopes.colPivHouseholderQr().solve(off_mm);
    centre_mm += change.head<3>();
    depth_mm += change(3);
  }
  return off_mm;
}

class ShapedDome : public testing::Test {
 protected:
  ShapedDome() {
    ShapeOptions asked;
    asked.target.surface = sphere(kDomeRadius_mm);
    asked.from_deg = kStowed_deg;
    study_ = *shape(solver_, asked);
    options_.shape =
        std::make_shared<const ShapeMeasure>(*ShapeMeasure::of(solver_, asked.target, kDome_deg));
    options_.shifted = all_vertices(base_.base.sheet);
    options_.amplitude_mm = 1.2 * study_.shifts_mm.cwiseAbs().maxCoeff();
    options_.deploying.from_deg = kStowed_deg;
    options_.deploying.sheet.springs().rest_deg = kDome_deg;
    options_.deploys_from_sample = 100;
    options_.most_steps = 4;
  }

  double max_mm(const Eigen::Matrix2Xd& shifts_mm) {
    return distances_mm(shifts_mm).lpNorm<Eigen::Infinity>();
  }
  VectorXd distances_mm(const Eigen::Matrix2Xd& shifts_mm) {
    const Sheet sheet(solver_, shifts_mm);
    return distances_from_a_dome_mm(sheet.at(kDome_deg).vertices_mm, study_.sides, study_.pose);
  }

  TestSheet base_{4, 4};
  Model model_{base_.base};
  SheetSolver solver_{model_};
  ShapeStudy study_;
  OptimiseOptions options_;
};

TEST_F(ShapedDome, IsKeptWhileItsStopBecomesStiffer) {
  options_.goal = goal_named("rest_stiffness_n_mm_per_rad");
  options_.floors = {{goal_named("shape_max_mm"), -0.5}};
  const Sheet start(solver_, study_.shifts_mm);
  const auto found = optimise(start, options_);
  ASSERT_TRUE(found);
  EXPECT_GT(found->best().value, 1.3 * found->start().value);
  // Poses are fitted to 1e-7 of their distances.
  EXPECT_LE(max_mm(found->best().shifts_mm), 0.5 + 1e-6);
  EXPECT_GT(max_mm(found->best().shifts_mm), 0.1) << "what is allowed is used";
}

TEST_F(ShapedDome, IsComeBackToFromBeside) {
  const Eigen::Matrix2Xd beside_mm =
      study_.shifts_mm + 0.1 * Eigen::Matrix2Xd::Random(2, study_.shifts_mm.cols());
  const Sheet start(solver_, beside_mm);
  for (const char* name : {"shape_rms_mm", "shape_max_mm"}) {
    options_.goal = goal_named(name);
    const auto found = optimise(start, options_);
    ASSERT_TRUE(found) << name;
    const VectorXd before_mm = distances_mm(beside_mm),
                   after_mm = distances_mm(found->best().shifts_mm);
    const auto measured = [&](const VectorXd& mm) {
      return options_.goal == goal_named("shape_max_mm")
                 ? mm.lpNorm<Eigen::Infinity>()
                 : mm.norm() / std::sqrt(static_cast<double>(mm.size()));
    };
    EXPECT_NEAR(-found->start().value, measured(before_mm), 1e-6) << name;
    EXPECT_NEAR(-found->best().value, measured(after_mm), 1e-6) << name;
    EXPECT_LT(measured(after_mm), measured(before_mm) / 4) << name;
  }
}

TEST_F(ShapedDome, IsRefusedWithABoundThatItDoesNotKeep) {
  options_.goal = goal_named("rest_stiffness_n_mm_per_rad");
  options_.floors = {{goal_named("shape_max_mm"), -1e-9}};
  const auto found = optimise(Sheet(solver_, study_.shifts_mm), options_);
  ASSERT_TRUE(found.fault());
  EXPECT_EQ(found.fault()->value, "shape_max_mm <= 1e-09");
}

}  // namespace
}  // namespace misalign::solver
