// Sheets to begin an optimisation with.
#pragma once

#include <random>

#include "solver/optimise/optimise.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {

class Optimising : public testing::Test {
 protected:
  Optimising() {
    options_.shifted = base_.shifted_vertices;
    options_.deploys_from_sample = 150;
    options_.deploying.from_deg = 36;
  }

  // The next ones of a random sequence that deploy from 150 degrees, and that springs which are
  // relaxed flat drive there.
  Eigen::Matrix2Xd next_start(bool ternary) {
    for (;;) {
      Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base_.base.sheet.vertex_count());
      for (const int vertex : base_.shifted_vertices) {
        for (double& shift : shifts_mm.col(vertex)) {
          shift = ternary ? 0.4 * (static_cast<int>(random_() % 3) - 1)
                          : 0.8 * (static_cast<double>(random_() % 1000) / 999 - 0.5);
        }
      }
      const Sheet sheet(solver_, shifts_mm);
      ReleaseOptions flat = options_.deploying;
      flat.sheet.fill = Springs{};
      if (sheet.deploys_from_deg() >= 150 && friction(sheet, flat) > 0) return shifts_mm;
    }
  }

  static double friction(const Sheet& sheet, const ReleaseOptions& deploying) {
    return static_release(sheet, deploying)->friction.critical_n_mm_per_mm.value_or(0);
  }
  double friction(const Eigen::Matrix2Xd& shifts_mm) {
    return friction(Sheet(solver_, shifts_mm), options_.deploying);
  }

  const std::uint64_t seed_ = 20261129;
  std::mt19937_64 random_{seed_};
  DrawableSheet base_{4, 4};
  Model model_{base_.base};
  SheetSolver solver_{model_};
  OptimiseOptions options_;
};

}  // namespace misalign::solver
