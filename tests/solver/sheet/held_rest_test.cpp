// Springs relaxed at a target drive a sheet to it: angles and barriers, against sums over poses.
#include "solver/sheet/held_rest.hpp"

#include <gtest/gtest.h>

#include "solver/sheet/followed_base.hpp"
#include "solver/sheet/sheet_filling.hpp"
#include "tests/solver/designed_mesh.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::solver {
namespace {

TEST(HeldRest, AsEnergiesOfPosesSay) {
  const DesignedMesh mesh = curved_mesh(6, 6, {6e-4, -4e-4}, 0.5, 7);
  const std::vector<int> holes = checkerboard(mesh.flat, 1);
  const auto base = std::get<FollowedBase>(
      follow_from_target(mesh.flat, holes, default_pilot(mesh.flat, holes), mesh.folded_mm));
  const OwnSheet own({mesh.flat, holes, base.folding},
                     Eigen::Matrix2Xd::Zero(2, mesh.flat.vertex_count()),
                     {.end_deg = base.folding.end_deg()});
  const FoldingWay& way = *own.sheet.way();
  const HeldRest held =
      held_rest(way, filling_on(way, Springs{.rest_deg = base.target_deg}), base.target_deg);
  // Lengths between vertices, without the filling's code: 50 N/mm each.
  const auto lengths = [&](const Eigen::Matrix3Xd& at) {
    std::vector<double> both;
    for (const int hole : holes) {
      const auto& v = mesh.flat.facets[hole];
      both.push_back((at.col(v[0]) - at.col(v[2])).norm());
      both.push_back((at.col(v[1]) - at.col(v[3])).norm());
    }
    return both;
  };
  const std::vector<double> rest_mm = lengths(mesh.folded_mm);
  const auto energy = [&](double pilot_deg) {
    const std::vector<double> now_mm = lengths(own.sheet.at(pilot_deg).vertices_mm);
    double sum = 0;
    for (std::size_t d = 0; d < now_mm.size(); ++d) sum += 25 * std::pow(now_mm[d] - rest_mm[d], 2);
    return sum;
  };
  constexpr double kStep_deg = 0.5;
  const double end_deg = std::min(way.end_deg(), way.over_folded_deg().value_or(180));
  double from_deg = base.target_deg, below_deg = base.target_deg, up = 0, down = 0;
  while (from_deg + kStep_deg < end_deg && energy(from_deg + kStep_deg) > energy(from_deg))
    from_deg += kStep_deg;
  while (below_deg > kStep_deg && energy(below_deg - kStep_deg) > energy(below_deg))
    below_deg -= kStep_deg;
  for (double at = base.target_deg; at < end_deg; at += kStep_deg) up = std::max(up, energy(at));
  for (double at = base.target_deg; at > 0; at -= kStep_deg) down = std::max(down, energy(at));
  EXPECT_NEAR(held.driven_from_deg, from_deg, kStep_deg);
  EXPECT_NEAR(held.driven_from_below_deg, below_deg, kStep_deg);
  EXPECT_GT(held.driven_from_deg - base.target_deg, 2);
  EXPECT_GT(base.target_deg - held.driven_from_below_deg, 10);
  if (held.is_from_end) up = energy(end_deg);
  EXPECT_NEAR(held.barrier_n_mm, std::min(up, down), 1e-3 * std::min(up, down));
  EXPECT_NEAR(held.barrier_n_mm, energy(held.barrier_deg), 1e-6 * held.barrier_n_mm);
}

}  // namespace
}  // namespace misalign::solver
