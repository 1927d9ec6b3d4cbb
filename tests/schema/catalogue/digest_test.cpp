// The digest is what the contract says, recomputed from bytes and in 128 bits.
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

TEST(CandidateSum, IsTheSumModulo2To128) {
  const Wide one = 1, all = ~Wide{0};
  const Wide kValues[] = {0,   one,      (one << 64) - 1, one << 64,      (one << 127) + 5,
                          all, all - 41, all << 64,       (one << 64) + 7};
  for (const Wide a : kValues) {
    EXPECT_TRUE(as_wide(as_sum(a)) == a);
    for (const Wide b : kValues) {
      CandidateSum ab = as_sum(a), ba = as_sum(b);
      ab.add(as_sum(b));
      ba.add(as_sum(a));
      EXPECT_TRUE(as_wide(ab) == a + b) << hex_of(a) << " + " << hex_of(b);
      EXPECT_TRUE(ab == ba);
    }
  }
}

TEST(CandidateSum, AddsTheHashOfDrawAndSample) {
  constexpr std::pair<std::uint64_t, int> kCandidates[] = {
      {0, 1}, {1, 0}, {77, 156}, {1ULL << 40, 180}, {kEndOfDraws - 1, 18000}};
  CandidateSum forward, backward;
  Wide sum = 0;
  for (const auto& [draw, sample] : kCandidates) {
    forward.add(draw, sample);
    sum += xxh3(little_endian(draw, 8) + little_endian(static_cast<unsigned>(sample), 4));
    EXPECT_TRUE(as_wide(forward) == sum) << draw;
  }
  for (auto at = std::rbegin(kCandidates); at != std::rend(kCandidates); ++at) {
    backward.add(at->first, at->second);
  }
  EXPECT_TRUE(forward == backward);
}

TEST(Digest, IsMadeOfTheBytesOfTheContract) {
  const std::string identity(32, 'e');
  CandidateSum sum;
  sum.add(5, 170);
  sum.add(4096, 180);
  const std::vector<DrawRange> merged = {{0, 4096}, {4096 + 7, kEndOfDraws}};
  EXPECT_EQ(catalogue_digest(identity, merged, 2, 3, sum),
            expected_digest(identity, merged, {{5, 170}, {4096, 180}}, 3));
  EXPECT_EQ(catalogue_digest(identity, {}, 0, 0, {}), expected_digest(identity, {}, {}, 0));
  EXPECT_EQ(hex(hash_of("misalign")), hex_of(xxh3("misalign")));
}

TEST(Goal, PlannedEnd) {
  EXPECT_EQ((Goal{{0, 100}, {}, {}}.planned_end()), 100u);
  EXPECT_EQ((Goal{{0, 100}, 40, {}}.planned_end()), 40u);
  EXPECT_EQ((Goal{{50, 100}, 40, {}}.planned_end()), 90u);
  EXPECT_EQ((Goal{{50, 100}, 60, {}}.planned_end()), 100u);
  EXPECT_EQ((Goal{{50, kEndOfDraws}, kEndOfDraws, {}}.planned_end()), kEndOfDraws);
}

}  // namespace
}  // namespace misalign::schema
