// Distances of folded sheets from surfaces with closed forms, by formulas of dual numbers.
#include "solver/target/shape_measure.hpp"

#include <array>
#include <functional>

#include "tests/solver/blocks.hpp"
#include "tests/solver/dual.hpp"

namespace misalign::solver {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using DualPoint = std::array<Dual, 3>;

constexpr double kMeasuredRadius_mm = 900, kAt_deg = 60;

Dual dual_norm(Dual x, Dual y, Dual z) { return sqrt(x * x + y * y + z * z); }

Dual sphere_distance(const DualPoint& p) {
  return dual_norm(p[0], p[1], p[2] + Dual(kMeasuredRadius_mm)) - Dual(kMeasuredRadius_mm);
}

Dual cylinder_distance(const DualPoint& p) {
  return dual_norm(0, p[1], p[2] + Dual(kMeasuredRadius_mm)) - Dual(kMeasuredRadius_mm);
}

// The foot (u, v) of z = (u^2 - v^2) / 2R: x = u + g u, y = v - g v with g = (h - z) / R, and so
// u = x / (1 + g), v = y / (1 - g): Newton's method in g alone.
Dual saddle_distance(const DualPoint& p) {
  const Dual radius(kMeasuredRadius_mm), one(1.0), half(0.5);
  Dual g = 0;
  for (int step = 0; step < 30; ++step) {
    const Dual u = p[0] / (one + g), v = p[1] / (one - g);
    const Dual off = half * (u * u - v * v) / radius - p[2] - radius * g,
               slope = -(u * u / (one + g) + v * v / (one - g)) / radius - radius;
    g = g - off / slope;
  }
  const Dual u = p[0] / (one + g), v = p[1] / (one - g);
  // The point is below its foot by g R along (-u / R, v / R, 1).
  return -g * sqrt(u * u + v * v + radius * radius);
}

struct ClosedFormSurface {
  std::shared_ptr<const TargetSurface> surface;
  Dual (*distance)(const DualPoint&);
};

class ClosedFormSurfaces : public testing::Test {
 protected:
  Matrix3Xd next_folded() {
    std::uniform_real_distribution<double> shift_mm(-2, 2);
    for (;;) {
      const Eigen::Matrix2Xd shifts_mm =
          Eigen::Matrix2Xd::Zero(2, base_.base.sheet.vertex_count()).unaryExpr([&](double) {
            return shift_mm(random_);
          });
      const Sheet sheet(solver_, shifts_mm);
      if (!sheet.way() || sheet.way()->end_deg() <= kAt_deg) continue;
      return sheet.at(kAt_deg).vertices_mm;
    }
  }

  const ClosedFormSurface forms_[3] = {{sphere(kMeasuredRadius_mm), sphere_distance},
                                       {cylinder(kMeasuredRadius_mm, true), cylinder_distance},
                                       {saddle(kMeasuredRadius_mm), saddle_distance}};
  std::mt19937_64 random_{20261130};
  DrawableSheet base_{4, 4};
  Model model_{base_.base};
  SheetSolver solver_{model_};
};

// A place after a turn by dual angles about the axes of the target, and a move.
DualPoint moved(const Vector3d& mm, int change) {
  DualPoint place = {mm.x(), mm.y(), mm.z()};
  const Dual angle(0, 1);
  if (change < 3) {
    const auto a = static_cast<std::size_t>((change + 1) % 3),
               b = static_cast<std::size_t>((change + 2) % 3);
    const DualPoint before = place;
    place[a] = before[a] - angle * before[b];
    place[b] = before[b] + angle * before[a];
  } else if (change < 6) {
    place[static_cast<std::size_t>(change - 3)].b = 1;
  }
  return place;
}

// Relative to 100 mm, at which lever arms of turns are.
constexpr double kRounding = 1e-8;

TEST_F(ClosedFormSurfaces, HaveTheDerivativesOfDualNumbers) {
  constexpr int kSheets = 100;
  for (const ClosedFormSurface& form : forms_) {
    WantedShape wanted;
    wanted.surface = form.surface;
    const ShapeMeasure measure = *ShapeMeasure::of(solver_, wanted, kAt_deg);
    const ShapeTarget& target = measure.target();
    double worst_mm = 0, worst_pose = 0, worst_place = 0;
    for (int sheet = 0; sheet < kSheets; ++sheet) {
      const Matrix3Xd folded_mm = next_folded();
      ShapePose pose;
      Eigen::Matrix<double, 7, 1> change = Eigen::Matrix<double, 7, 1>::Random();
      change.head<3>() *= 0.2;
      change.tail<4>() *= 10;
      pose.move_mm = -folded_mm.rowwise().mean();
      pose = pose.after(change);
      const ShapeMisfit found = misfit(target, folded_mm, pose);
      for (Eigen::Index v = 0; v < folded_mm.cols(); ++v) {
        const Vector3d placed_mm = pose.turn * folded_mm.col(v) + pose.move_mm;
        for (int k = 0; k < 7; ++k) {
          const Dual depth(pose.half_depth_mm, k == 6 ? 1 : 0);
          const Dual away = form.distance(moved(placed_mm, k)) - Dual(target.sides(v)) * depth;
          worst_mm = std::max(worst_mm, std::abs(away.a - found.mm(v)));
          const double arm_mm = k < 3 ? 100 : 1;
          worst_pose = std::max(worst_pose, std::abs(away.b - found.by_pose(v, k)) / arm_mm);
        }
        for (int k = 0; k < 3; ++k) {
          DualPoint place = {placed_mm.x(), placed_mm.y(), placed_mm.z()};
          for (std::size_t row = 0; row < 3; ++row) {
            place[row].b = pose.turn(static_cast<Eigen::Index>(row), k);
          }
          worst_place = std::max(worst_place, std::abs(form.distance(place).b - found.by_mm(k, v)));
        }
      }
    }
    EXPECT_LT(worst_mm, 100 * kRounding);
    EXPECT_LT(worst_pose, kRounding);
    EXPECT_LT(worst_place, kRounding);
  }
}

// No pose nearby has smaller squares, and where the sheet lies does not matter.
TEST_F(ClosedFormSurfaces, AreFittedWithTheLeastSquares) {
  for (const ClosedFormSurface& form : forms_) {
    WantedShape wanted;
    wanted.surface = form.surface;
    const ShapeMeasure measure = *ShapeMeasure::of(solver_, wanted, kAt_deg);
    for (int sheet = 0; sheet < 10; ++sheet) {
      const Matrix3Xd folded_mm = next_folded();
      const ShapeMisfit found = measure.fitted(folded_mm);
      const Eigen::VectorXd slope = found.by_pose.transpose() * found.mm;
      for (int k = 0; k < 7; ++k) {
        EXPECT_LT(std::abs(slope(k)), 1e-4 * found.by_pose.col(k).norm() * found.mm.norm()) << k;
      }
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(2, Vector3d::Random().normalized()).toRotationMatrix();
      const ShapeMisfit elsewhere =
          measure.fitted((turn * folded_mm).colwise() + Vector3d(9, 8, 7));
      EXPECT_LT((elsewhere.mm - found.mm).cwiseAbs().maxCoeff(), 1e-4 * found.max_mm());
    }
  }
}

TEST_F(ClosedFormSurfaces, AreNoneBeyondTheEndOfAWay) {
  WantedShape wanted;
  wanted.surface = sphere(kMeasuredRadius_mm);
  Eigen::Matrix2Xd shifts_mm(2, base_.base.sheet.vertex_count());
  for (Eigen::Index k = 0; k < shifts_mm.size(); ++k) {
    shifts_mm(k % 2, k / 2) = 0.3 * std::sin(7.0 * static_cast<double>(k));
  }
  const Sheet sheet(solver_, shifts_mm);
  EXPECT_TRUE(shape_misfit_of(sheet, wanted, sheet.way()->end_deg() - 1));
  EXPECT_FALSE(shape_misfit_of(sheet, wanted, sheet.way()->end_deg()));
}

}  // namespace
}  // namespace misalign::solver
