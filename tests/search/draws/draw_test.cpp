#include "search/draws/draw.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "search/sheets/backlash.hpp"

namespace misalign::search {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Random123's kat_vectors (zeros, ones, digits of pi), and the contract's.
TEST(Draw, KnownAnswers) {
  EXPECT_EQ(philox_block(0, 0, 0, 0), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox_block(~0ULL, ~0ULL, ~0U, ~0U),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox_block(0x299f31d0a4093822ULL, 0x85a308d3243f6a88ULL, 0x13198a2e, 0x03707344),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
  EXPECT_EQ(philox_block(1, 0, 0, kDrawStream),
            (Block{0xe3e80670, 0xe50a0ebc, 0x95f222c0, 0xb615aa27}));
  EXPECT_TRUE(random_numbers_as_published());
}

// Sixteen draws side by side, on the registers that the machine has, against Random123 one by one:
// over a carry into the draw's high half, and with every bit of key, block and stream set.
TEST(Draw, WordsSideBySideAreThoseOneByOne) {
  for (const std::uint64_t seed : {0ULL, 1ULL, ~0ULL, 0x299f31d0a4093822ULL}) {
    for (const std::uint64_t first : {0ULL, (1ULL << 32) - 7, ~0ULL - 15}) {
      for (const std::uint32_t block : {0U, 12U, ~0U}) {
        WordsOfDraws words;
        philox_blocks(seed, first, block, ~block, words);
        for (std::size_t k = 0; k < kDrawsAtOnce; ++k) {
          EXPECT_EQ((Block{words[0][k], words[1][k], words[2][k], words[3][k]}),
                    philox_block(seed, first + k, block, ~block))
              << "draw " << first + k;
        }
      }
    }
  }
}

// A run of draws, whole sixteens and what is left, of ternary and uniform shifts.
TEST(Draw, ManyDrawsAreEachItsOwn) {
  for (const auto distribution :
       {schema::ShiftDistribution::ternary, schema::ShiftDistribution::uniform}) {
    const schema::Misalignment some{{1, 2, 3, 5, 8, 13, 21}, 0.4, distribution};
    std::vector<double> all(14 * 37), one(14);
    draw_shifts(some, 5, 1000, 37, all.data());
    for (std::uint64_t k = 0; k < 37; ++k) {
      draw_shifts(some, 5, 1000 + k, one.data());
      EXPECT_TRUE(std::equal(one.begin(), one.end(), all.begin() + static_cast<long>(14 * k))) << k;
    }
  }
}

// Contract: seed 1, draw 0 has the levels +1 +1 0 +1.
TEST(Draw, TernaryLevelsOfTheContract) {
  const schema::Misalignment two{{8, 9}, 0.4, schema::ShiftDistribution::ternary};
  Eigen::Matrix2Xd shifts = Eigen::Matrix2Xd::Zero(2, 49);
  draw_shifts(two, 1, 0, shifts);
  EXPECT_EQ(shifts.col(8), Eigen::Vector2d(0.4, 0.4));
  EXPECT_EQ(shifts.col(9), Eigen::Vector2d(0.0, 0.4));
  EXPECT_EQ(shifts.cwiseAbs().sum(), 0.4 * 3);
}

// The k-th vertex takes words 2k and 2k + 1, four to a block: recomputed from the blocks.
TEST(Draw, WordsGoToVerticesInOrder) {
  schema::Misalignment uniform{{}, 0.25, schema::ShiftDistribution::uniform};
  for (int v = 0; v < 25; ++v) uniform.vertices.push_back(2 * v);
  Eigen::Matrix2Xd shifts = Eigen::Matrix2Xd::Zero(2, 50);
  const std::uint64_t seed = 0x123456789abcULL, draw = 0x7edcba9876543210ULL;
  draw_shifts(uniform, seed, draw, shifts);
  for (int k = 0; k < 25; ++k) {
    const Block block = philox_block(seed, draw, static_cast<std::uint32_t>(k / 2), 0);
    for (int axis = 0; axis < 2; ++axis) {
      const double w = block[2 * (k % 2) + axis];
      EXPECT_DOUBLE_EQ(shifts(axis, 2 * k), ((w + 0.5) / 2147483648.0 - 1.0) * 0.25);
    }
  }
  EXPECT_LE(shifts.cwiseAbs().maxCoeff(), 0.25);
}

// A third each: the standard error over 200,000 words is 0.00105, five of them allowed.
TEST(Draw, TernaryLevelsAreEquallyLikely) {
  const schema::Misalignment ten{
      {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, 1.0, schema::ShiftDistribution::ternary};
  std::array<int, 3> count{};
  Eigen::Matrix2Xd shifts(2, 10);
  for (std::uint64_t draw = 0; draw < 10000; ++draw) {
    draw_shifts(ten, 7, draw, shifts);
    for (const double level : shifts.reshaped()) ++count[static_cast<int>(level) + 1];
  }
  for (const int n : count) EXPECT_NEAR(n / 200000.0, 1 / 3.0, 5 * 0.00105);
}

// Points of trials are the first in the ball of what stream 2 has for them; and uniform there: of
// 20,000 the mean of |x|^2 is 3/5 with a standard error of 0.0019, that of x 0 with one of 0.0032.
TEST(Draw, PointsInTheBall) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  constexpr int kPoints = 20000;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    const auto p = point_in_ball(7, 3, k);
    std::uint32_t block = 64 * k;
    Eigen::Vector3d expected;
    do {
      const Block words = philox_block(7, 3, block++, 2);
      for (int i = 0; i < 3; ++i) expected[i] = (words[i] + 0.5) / 2147483648.0 - 1.0;
    } while (expected.norm() > 1);
    ASSERT_LE(block, 64 * k + 64);
    EXPECT_EQ(Eigen::Vector3d(p.x, p.y, p.z), expected);
    sum += expected;
    squares += expected.squaredNorm();
  }
  EXPECT_NEAR(squares / kPoints, 0.6, 5 * 0.0019);
  EXPECT_LE((sum / kPoints).cwiseAbs().maxCoeff(), 5 * 0.0032);
}

// Creases first, each at a and at b, then ball joints; other trials and seeds have others.
TEST(Draw, OffsetsAreTheTrialsPoints) {
  const schema::Campaign campaign = schema::read_campaign(
      {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}}, {"seed", 7u}}, "a test");
  const solver::PerforatedSheet& base = campaign.pattern.base;
  const auto mechanism = solver::build_mechanism(base);
  const auto offsets = trial_offsets(mechanism, campaign.seed, 5);
  ASSERT_EQ(offsets.creases_a.size(), mechanism.creases.size());
  ASSERT_EQ(offsets.creases_b.size(), mechanism.creases.size());
  ASSERT_EQ(offsets.balls.size(), mechanism.balls.size());
  const auto same = [](const auto& p, const auto& q) {
    return p.x == q.x && p.y == q.y && p.z == q.z;
  };
  EXPECT_TRUE(same(offsets.creases_b[3], point_in_ball(7, 5, 7)));
  const auto creases = static_cast<std::uint32_t>(mechanism.creases.size());
  EXPECT_TRUE(same(offsets.balls[0], point_in_ball(7, 5, 2 * creases)));
  EXPECT_FALSE(same(offsets.creases_a[0], trial_offsets(mechanism, 7, 6).creases_a[0]));
  EXPECT_FALSE(same(offsets.creases_a[0], trial_offsets(mechanism, 8, 5).creases_a[0]));
}

}  // namespace
}  // namespace misalign::search
