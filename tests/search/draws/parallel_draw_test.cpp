// Draws of members of the parallel family, against the family's conditions written down here.
#include "search/draws/parallel_draw.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/hash.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "solver/pattern/parallel_family.hpp"

namespace misalign::search {
namespace {

using Vec = Eigen::Vector2d;

double cross(const Vec& u, const Vec& v) { return u.x() * v.y() - u.y() * v.x(); }

schema::Campaign campaign_of(int size, const schema::Json& misalignment) {
  return schema::read_campaign(
      {{"pattern", {{"family", "miura"}, {"rows", size}, {"columns", size}}},
       {"misalignment", misalignment},
       {"accept", {{"deploys_from_deg", 179}}}},
      "test");
}

// delta and epsilon of a hole, mm: its edges along a and b are A a + epsilon b and B b + delta a.
struct HoleChange {
  double delta_mm, epsilon_mm;
};

class Member {
 public:
  Member(const schema::Campaign& campaign, std::uint64_t draw)
      : base_(campaign.pattern.base),
        shifts_mm_(shifts_of_draw(campaign, draw)),
        vertices_mm_(base_.sheet.vertices_mm + shifts_mm_) {}

  const Eigen::Matrix2Xd& shifts_mm() const { return shifts_mm_; }
  /// The most that a crease's end lies beside its direction, or that opposite edges of a hole
  /// differ.
  double off_mm() const {
    double most = 0;
    const solver::Mechanism mechanism = solver::build_mechanism(base_);
    for (const solver::Crease& crease : mechanism.creases) {
      const Vec was = base_.sheet.vertices_mm.col(crease.b) - base_.sheet.vertices_mm.col(crease.a);
      const Vec is = vertices_mm_.col(crease.b) - vertices_mm_.col(crease.a);
      most = std::max(most, std::abs(cross(was.normalized(), is)));
    }
    for (std::size_t h = 0; h < base_.holes.size(); ++h) {
      most = std::max(most, (edge(h, 0, vertices_mm_) + edge(h, 2, vertices_mm_)).norm());
    }
    return most;
  }
  HoleChange change(std::size_t hole) const {
    const Vec a = edge(hole, 0, base_.sheet.vertices_mm).normalized(),
              b = edge(hole, 1, base_.sheet.vertices_mm).normalized();
    return {cross(edge(hole, 1, vertices_mm_), b) / cross(a, b),
            cross(a, edge(hole, 0, vertices_mm_)) / cross(a, b)};
  }
  bool has_like_signs() const {
    for (std::size_t h = 0; h < base_.holes.size(); ++h) {
      if (!(change(h).delta_mm * change(h).epsilon_mm > 0)) return false;
    }
    return true;
  }

 private:
  Vec edge(std::size_t hole, int k, const Eigen::Matrix2Xd& at_mm) const {
    const auto& corners = base_.sheet.facets[static_cast<std::size_t>(base_.holes[hole])];
    return at_mm.col(corners[static_cast<std::size_t>((k + 1) % 4)]) -
           at_mm.col(corners[static_cast<std::size_t>(k)]);
  }

  const solver::PerforatedSheet& base_;
  Eigen::Matrix2Xd shifts_mm_, vertices_mm_;
};

TEST(ParallelDraw, IsAMemberWithinTheAmplitude) {
  for (const auto& [vertices, signs] :
       {std::pair("interior", "alike"), std::pair("all", "alike"), std::pair("all", "free")}) {
    SCOPED_TRACE(std::string(vertices) + ", " + signs);
    const schema::Campaign campaign = campaign_of(
        6, {{"kind", "parallel"}, {"vertices", vertices}, {"signs", signs}, {"amplitude_mm", 4}});
    int alike = 0;
    for (std::uint64_t draw = 0; draw < 200; ++draw) {
      const Member member(campaign, draw);
      EXPECT_LE(member.off_mm(), 1e-12 * 80 * 6) << draw;  // roundings of coordinates
      EXPECT_LE(member.shifts_mm().cwiseAbs().maxCoeff(), 4 * (1 + 1e-15)) << draw;
      EXPECT_GT(member.shifts_mm().cwiseAbs().maxCoeff(), 0.4) << draw;
      EXPECT_TRUE(can_be_drawn(campaign, member.shifts_mm())) << draw;
      alike += member.has_like_signs();
    }
    EXPECT_TRUE(signs == std::string("alike") ? alike == 200 : alike < 20) << alike;
  }
}

// On a grid too, with few holes or all: whole multiples, members still; coarse ones as well, of
// which the ternary are the coarsest.
TEST(ParallelDraw, KeepsToAGrid) {
  for (const auto& [amplitude_mm, grid_mm, signs] :
       {std::tuple(4.0, 0.25, "alike"), std::tuple(4.0, 0.01, "free"), std::tuple(3.0, 2.0, "free"),
        std::tuple(0.4, 0.4, "free")}) {
    SCOPED_TRACE(grid_mm);
    const schema::Campaign campaign = campaign_of(6, {{"kind", "parallel"},
                                                      {"vertices", "all"},
                                                      {"amplitude_mm", amplitude_mm},
                                                      {"grid_mm", grid_mm},
                                                      {"signs", signs}});
    int moved = 0, alike = 0;
    for (std::uint64_t draw = 0; draw < 200; ++draw) {
      const Member member(campaign, draw);
      const Eigen::ArrayXXd steps = member.shifts_mm().array() / grid_mm;
      EXPECT_LE((steps - steps.round()).abs().maxCoeff(), 1e-12) << draw;
      EXPECT_LE(member.off_mm(), 1e-12 * 80 * 6) << draw;
      EXPECT_LE(member.shifts_mm().cwiseAbs().maxCoeff(), amplitude_mm * (1 + 1e-9)) << draw;
      EXPECT_TRUE(can_be_drawn(campaign, member.shifts_mm())) << draw;
      moved += member.shifts_mm().cwiseAbs().maxCoeff() > 0;
      alike += member.has_like_signs();
    }
    EXPECT_GT(moved, 150);
    EXPECT_TRUE(signs == std::string("free") || alike == 200) << alike;
  }
  const schema::Campaign campaign = campaign_of(6, {{"kind", "parallel"}, {"grid_mm", 0.1}});
  Eigen::Matrix2Xd shifts_mm = shifts_of_draw(campaign, 3);
  EXPECT_TRUE(can_be_drawn(campaign, shifts_mm));
  EXPECT_FALSE(can_be_drawn(campaign, 0.5 * shifts_mm));
}

// Of the first draw: its holes' numbers are the words', each times the amplitude and the factor by
// which the member is made smaller as a whole.
TEST(ParallelDraw, CoordinatesTakeTheWordsInTheirOrder) {
  const schema::Campaign campaign =
      campaign_of(4, {{"kind", "parallel"}, {"vertices", "all"}, {"signs", "free"}});
  const Member member(campaign, 7);
  const auto& coordinates = campaign.misalignment.parallel->family->coordinates();
  double factor = 0;
  int of_holes = 0;
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    const solver::ParallelCoordinate& coordinate = coordinates[k];
    if (coordinate.hole < 0) continue;
    const HoleChange change = member.change(static_cast<std::size_t>(coordinate.hole));
    const double value_mm = coordinate.kind == solver::ParallelCoordinate::Kind::delta
                                ? change.delta_mm
                                : change.epsilon_mm;
    const auto words = philox_block(1, 7, static_cast<std::uint32_t>(k / 4), kDrawStream);
    const double share = (words[k % 4] + 0.5) / 2147483648.0 - 1.0;
    if (of_holes++ == 0) factor = value_mm / share;
    EXPECT_NEAR(value_mm, factor * share, 1e-12);  // shifts of 0.4 mm on places of 320 mm
  }
  EXPECT_EQ(of_holes, 4);
  EXPECT_LE(factor, 0.4 * (1 + 1e-12));
}

TEST(ParallelDraw, WhatIsNoMemberCannotBeDrawn) {
  const schema::Campaign campaign = campaign_of(6, {{"kind", "parallel"}});
  Eigen::Matrix2Xd shifts_mm = shifts_of_draw(campaign, 3);
  EXPECT_TRUE(can_be_drawn(campaign, shifts_mm));
  EXPECT_FALSE(can_be_drawn(campaign, 10 * shifts_mm));
  shifts_mm(0, 16) += 1e-6;
  EXPECT_FALSE(can_be_drawn(campaign, shifts_mm));
}

// The theorem, and the independent way: the ordinary path and its diagonals, up to 179 degrees.
TEST(ParallelDraw, MembersWithLikeSignsDeployFromTheLastSample) {
  for (const double amplitude_mm : {0.2, 8.0}) {
    DrawEvaluator evaluator(campaign_of(6, {{"kind", "parallel"}, {"amplitude_mm", amplitude_mm}}));
    const schema::UnitRecord unit = work_off(evaluator, {0, 100});
    EXPECT_EQ(unit.accepted, 100u) << amplitude_mm;
  }
}

// Frozen: these bits decide digests, on every machine.
TEST(ParallelDraw, HasTheSameBitsEverywhere) {
  std::string bytes;
  for (const char* vertices : {"interior", "all"}) {
    const schema::Campaign campaign =
        campaign_of(6, {{"kind", "parallel"}, {"vertices", vertices}, {"amplitude_mm", 4}});
    for (std::uint64_t draw = 0; draw < 100; ++draw) {
      const Eigen::Matrix2Xd shifts_mm = shifts_of_draw(campaign, draw);
      bytes.append(reinterpret_cast<const char*>(shifts_mm.data()),
                   static_cast<std::size_t>(shifts_mm.size()) * sizeof(double));
    }
  }
  EXPECT_EQ(schema::hex(schema::hash_of(bytes)), "c983d57ee5a4274028f246dbf0254822");
}

}  // namespace
}  // namespace misalign::search
