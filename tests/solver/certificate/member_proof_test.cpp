// Proofs of members of the parallel family in rational numbers, against followed loops.
#include "solver/certificate/member_proof.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "solver/records/record_sheet.hpp"
#include "tests/solver/families.hpp"
#include "tests/solver/few_holes.hpp"

namespace misalign::solver {
namespace {

TEST(MemberProof, ProvesLikeSignsToTheEnd) {
  const MiuraShape odd = MiuraShape::uniform(6, 6, 33.3, 70.1, 21.7);  // no numbers in binary
  for (const auto& holes : {std::vector<std::size_t>{5}, {0, 15}, {1, 4, 11, 14}}) {
    for (const PerforatedSheet& base : {with_holes(holes), with_holes(holes, odd)}) {
      for (const double most_mm : {0.2, 3.0}) {
        const Eigen::Matrix2Xd shifts_mm = member_of(base, most_mm, true, 4);
        const MemberProof proof = prove_member(base, shifts_mm, 180);
        ASSERT_TRUE(proof.holds()) << proof.gap.why(base.sheet);
        EXPECT_EQ(proof.certified_deg, 180);
        EXPECT_EQ(proof.reversing_hole, -1);
        // Sums of some dozen products of doubles; of a base that was rounded, as much as that.
        EXPECT_LE(proof.member_off_mm, proof.base_off_mm == 0 ? 1e-12 : 1e-9);
        EXPECT_LE(proof.base_off_mm, kProofGrid_mm);
      }
    }
  }
}

// As many as the environment asks for: ten thousand of each take minutes.
TEST(MemberProof, ProvesSheetsWithAllHolesToo) {
  const char* const asked = std::getenv("MISALIGN_MEMBERS");
  const int members = asked ? std::atoi(asked) : 20;
  for (const auto& [rows, columns] : {std::pair(4, 4), std::pair(6, 6), std::pair(8, 8)}) {
    const PerforatedSheet base = TestSheet(rows, columns).base;
    for (int k = 0; k < members; ++k) {
      const double most_mm = 0.2 * std::pow(60.0, k / static_cast<double>(members));
      const MemberProof proof =
          prove_member(base, member_of(base, most_mm, true, static_cast<unsigned>(k)), 180);
      ASSERT_TRUE(proof.holds()) << proof.gap.why(base.sheet);
      EXPECT_EQ(proof.certified_deg, 180) << most_mm;
      EXPECT_LE(proof.member_off_mm, 1e-12);
    }
  }
}

// Its loops, followed without the closed form of the diagonals, turn back just behind.
TEST(MemberProof, EndsAtTheReversal) {
  int turned = 0;
  for (const auto& holes : {std::vector<std::size_t>{5}, {0, 15}, {0, 2, 9}}) {
    const PerforatedSheet base = with_holes(holes);
    const Model model(base);
    for (unsigned seed = 0; seed < 12; ++seed) {
      const Eigen::Matrix2Xd shifts_mm = member_of(base, 4, false, seed);
      const MemberProof proof = prove_member(base, shifts_mm, 179);
      ASSERT_TRUE(proof.holds());
      const auto reverses_deg =
          record_on_base(model, base.sheet.vertices_mm + shifts_mm).extremes->reverses_deg;
      if (!reverses_deg || *reverses_deg > 179) {
        EXPECT_EQ(proof.certified_deg, 179);
        continue;
      }
      ++turned;
      EXPECT_TRUE(std::ranges::count(base.holes, proof.reversing_hole));
      EXPECT_LT(proof.certified_deg, *reverses_deg);
      EXPECT_NEAR(proof.certified_deg, *reverses_deg, 1e-5);
    }
  }
  EXPECT_GE(turned, 10);
}

// Off the family: how far the member is that is proven instead.
TEST(MemberProof, SaysHowFarItsMemberIs) {
  const PerforatedSheet base = with_holes({5});
  Eigen::Matrix2Xd shifts_mm = member_of(base, 4, true, 1);
  shifts_mm(1, 16) += 0.01;
  const MemberProof proof = prove_member(base, shifts_mm, 180);
  EXPECT_GE(proof.member_off_mm, parallel_misfit(base, shifts_mm).mm / 4);
  EXPECT_LE(proof.member_off_mm, 0.1);
}

TEST(MemberProof, TakesBasesWithMirrorsAlone) {
  const auto unshifted = [](const PerforatedSheet& base) {
    return prove_member(base, Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count()), 180);
  };
  for (const char* name : {"miura-wide-6x6", "miura-narrow-6x6", "miura-graded-6x6"}) {
    const PerforatedSheet base = CarriedFamily{name}.base;
    const MemberProof proof = unshifted(base);
    EXPECT_TRUE(proof.holds()) << name << ": " << proof.gap.why(base.sheet);
    EXPECT_EQ(proof.certified_deg, 0) << "nothing moves";
  }
  EXPECT_EQ(unshifted(CarriedFamily{"double-corrugation-6x6"}.base).gap.kind,
            ProofGap::Kind::no_mirror);
  // One vertex off by a ten thousandth of a millimetre.
  PerforatedSheet off = with_holes({5});
  off.sheet.vertices_mm(0, 24) += 1e-4;
  EXPECT_FALSE(unshifted(off).holds());
}

}  // namespace
}  // namespace misalign::solver
