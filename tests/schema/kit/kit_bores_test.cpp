// Bores: in their panels, clear of edges and of one another, or in tabs on the vertices; what does
// not fit is refused with what would.
#include "schema/kit/kit_bores.hpp"

#include <gtest/gtest.h>

#include <map>

#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// Least distance to the lines of a panel's edges; negative outside.
double depth(const solver::Sheet& sheet, int facet, const Vector2d& at) {
  double least = INFINITY;
  const auto& v = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  for (std::size_t k = 0; k < 4; ++k) {
    Eigen::Matrix2d m;
    m << sheet.point_mm(v[(k + 1) % 4]) - sheet.point_mm(v[k]), at - sheet.point_mm(v[k]);
    least = std::min(least, m.determinant() / m.col(0).norm());
  }
  return least;
}

KitOptions bores_of(std::optional<double> joint, std::optional<double> spring, double edge = 2,
                    SpringAt spring_at = SpringAt::panel) {
  KitOptions options;
  options.spring_at = spring_at;
  options.joint_bore_mm = joint;
  options.spring_bore_mm = spring;
  options.bore_edge_mm = edge;
  return options;
}

TEST(KitBores, LieInTheirPanelsAndClearOfOneAnother) {
  const KitFixture kit(8, 8);
  const auto bores = kit_fittings(kit.sheet, bores_of(1.2, 1.5)).bores;
  ASSERT_EQ(bores.size(), 2 * (kit.mechanism.balls.size() + kit.mechanism.diagonals.size()));
  std::map<int, int> joints;                   // by vertex
  std::map<std::pair<int, int>, int> springs;  // by spring and vertex
  for (const Bore& bore : bores) {
    const double radius = bore.diameter_mm / 2;
    EXPECT_EQ(bore.diameter_mm, bore.spring < 0 ? 1.2 : 1.5);
    EXPECT_FALSE(std::binary_search(kit.base.holes.begin(), kit.base.holes.end(), bore.facet));
    EXPECT_GE(depth(kit.sheet, bore.facet, bore.centre_mm), radius + 2 - 1e-9);
    for (const Bore& other : bores) {
      if (&other == &bore) continue;
      EXPECT_GE((other.centre_mm - bore.centre_mm).norm(),
                radius + other.diameter_mm / 2 + (other.facet == bore.facet ? 2 - 1e-9 : 0));
    }
    ++(bore.spring < 0 ? joints[bore.vertex] : springs[{bore.spring, bore.vertex}]);
  }
  for (const solver::BallJoint& ball : kit.mechanism.balls) EXPECT_EQ(joints[ball.vertex], 2);
  for (std::size_t d = 0; d < kit.mechanism.diagonals.size(); ++d) {
    for (const int v : {kit.mechanism.diagonals[d].from, kit.mechanism.diagonals[d].to}) {
      EXPECT_EQ((springs[{static_cast<int>(d), v}]), 1);
    }
  }
}

// In the panel across the vertex a spring pulls along the diagonal, or nearly.
TEST(KitBores, SpringsAtWholeVerticesGoOnAlongTheirDiagonals) {
  const KitFixture kit(4, 4);
  int whole = 0;
  for (const Bore& bore : kit_fittings(kit.sheet, bores_of({}, 1.5)).bores) {
    const solver::Diagonal& diagonal =
        kit.mechanism.diagonals[static_cast<std::size_t>(bore.spring)];
    const int other = diagonal.from == bore.vertex ? diagonal.to : diagonal.from;
    if (bore.vertex == kit.mechanism.balls.at(0).vertex) continue;
    const Vector2d along =
        (kit.sheet.point_mm(bore.vertex) - kit.sheet.point_mm(other)).normalized();
    EXPECT_GT(along.dot((bore.centre_mm - kit.sheet.point_mm(bore.vertex)).normalized()), 0.8);
    ++whole;
  }
  EXPECT_EQ(whole, 6);  // of eight ends two are at the ball joint
}

// On every vertex at which a spring ends: in the panel opposite to its hole, and at ball joints
// none.
TEST(KitBores, SpringsOnVerticesHaveTheirBoresInTabs) {
  const KitFixture kit(8, 8);
  const auto fittings = kit_fittings(kit.sheet, bores_of(1.2, 1.5, 2, SpringAt::vertex));
  const auto& facets = kit.base.sheet.facets;
  std::map<int, int> holes_at, bores_at;
  for (const int hole : kit.base.holes) {
    for (const int v : facets[static_cast<std::size_t>(hole)]) ++holes_at[v];
  }
  ASSERT_EQ(fittings.ends.size(), 2 * kit.mechanism.diagonals.size());
  for (const SpringEnd& end : fittings.ends) {
    EXPECT_EQ(end.at_mm, kit.sheet.point_mm(end.vertex));
    EXPECT_EQ(fittings.tab_at(end.vertex) != nullptr, holes_at[end.vertex] == 1);
  }
  for (const Bore& bore : fittings.bores) {
    if (bore.spring < 0) continue;
    ++bores_at[bore.vertex];
    EXPECT_EQ(bore.centre_mm, kit.sheet.point_mm(bore.vertex));
    const SpringTab* tab = fittings.tab_at(bore.vertex);
    ASSERT_NE(tab, nullptr);
    EXPECT_EQ(tab->facet, bore.facet);
    EXPECT_EQ(tab->radius_mm, 1.5 / 2 + 2);
    // Opposite: it has no other corner of the hole.
    const auto& panel = facets[static_cast<std::size_t>(bore.facet)];
    for (const int hole : kit.base.holes) {
      const auto& corners = facets[static_cast<std::size_t>(hole)];
      if (std::find(corners.begin(), corners.end(), bore.vertex) == corners.end()) continue;
      EXPECT_EQ(
          std::count_if(
              panel.begin(), panel.end(),
              [&](int v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); }),
          1);
    }
  }
  for (const auto& [vertex, holes] : holes_at) EXPECT_EQ(bores_at[vertex], holes == 1 ? 1 : 0);
}

TEST(KitBores, WhatDoesNotFitIsRefusedWithWhatWould) {
  const KitFixture kit(4, 4);
  const auto on_vertex = SpringAt::vertex;
  EXPECT_THROW(kit_fittings(kit.sheet, bores_of({}, 1, 0, on_vertex)), UserError);
  EXPECT_NO_THROW(kit_fittings(kit.sheet, bores_of({}, 1, 0.1, on_vertex)));
  using Size = std::optional<double>;
  for (const auto& [joint, spring, spring_at] :
       {std::tuple<Size, Size, SpringAt>{80, {}, SpringAt::panel},
        {{}, 80, SpringAt::panel},
        {60, 70, SpringAt::panel},
        {{}, 90, on_vertex},
        {50, 50, on_vertex}}) {
    const auto sized = [at = spring_at](Size one, Size other) {
      return bores_of(one, other, 2, at);
    };
    try {
      kit_fittings(kit.sheet, sized(joint, spring));
      FAIL() << "bores as large as panels";
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_request);
      const std::string words = error.what();
      const auto fits = [&](const std::string& option) -> std::optional<double> {
        const std::size_t at = words.rfind(option);
        if (at == std::string::npos) return std::nullopt;
        return std::stod(words.substr(at + option.size()));
      };
      const auto small_joint = fits("joint_bore_mm="), small_spring = fits("spring_bore_mm=");
      EXPECT_EQ(small_joint.has_value(), joint.has_value()) << words;
      EXPECT_NO_THROW(kit_fittings(kit.sheet, sized(small_joint, small_spring))) << words;
      const auto more = [](std::optional<double> bore) {
        return bore ? std::optional(1.02 * *bore) : bore;
      };
      EXPECT_THROW(kit_fittings(kit.sheet, sized(more(small_joint), more(small_spring))), UserError)
          << words;
    }
  }
  EXPECT_THROW(kit_fittings(kit.sheet, bores_of(1, {}, 60)), UserError);
  KitOptions within_kerf = bores_of(1, {});
  within_kerf.kerf_mm = 1;
  EXPECT_THROW(kit_fittings(kit.sheet, within_kerf), UserError);
  within_kerf.kerf_mm = 0.99;
  EXPECT_NO_THROW(kit_fittings(kit.sheet, within_kerf));
}

}  // namespace
}  // namespace misalign::schema
