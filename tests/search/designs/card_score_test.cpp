#include "search/designs/card_score.hpp"

#include <gtest/gtest.h>

namespace misalign::search {
namespace {

using schema::CardLine;
using Bound = CardLine::Bound;

CardLine line(const char* key, std::optional<double> wanted, std::optional<double> found,
              Bound bound = Bound::at_least, const char* unit = "") {
  return {key, key, unit, wanted, found, bound, ""};
}

TEST(CardScore, IsTheLeastReserve) {
  // 2.2 times the friction is overcome where twice it is required: a tenth more.
  const CardScore score = score_of({line("deploys_from_deg", 120, 170, Bound::at_least, "deg"),
                                    line("largest_stress_mpa", 40, 30, Bound::at_most),
                                    line("static_margin", 1, 1.2), line("mass_g", {}, 5)});
  EXPECT_NEAR(score.value, 0.1, 1e-12);
  EXPECT_EQ(score.key, "static_margin");
  EXPECT_TRUE(score.passes());
}

TEST(CardScore, AYieldIsComparedByTheCopiesThatMayFail) {
  // 5 of 100 copies may fail, and 4 do.
  EXPECT_NEAR(score_of({line("yield", 0.95, 0.96)}).value, 0.25, 1e-12);
  EXPECT_EQ(score_of({line("yield", 0.95, 1.0)}).value, kMostReserve);
}

TEST(CardScore, AnglesThatAreReachedDecideNothing) {
  const CardScore score = score_of({line("certified_deg", 120, 120, Bound::at_least, "deg")});
  EXPECT_EQ(score.value, kMostReserve);
  EXPECT_EQ(score.key, "");
}

TEST(CardScore, EachFailureCountsByItsShortfall) {
  const CardLine no_drive = line("static_margin", 1, -1), no_value = line("yield", 0.95, {}),
                 half = line("thickness_mm", 2, 1), touching = line("spring_clearance_mm", 0, -3);
  EXPECT_NEAR(score_of({no_drive}).value, -1, 1e-12);
  EXPECT_NEAR(score_of({no_value}).value, -1, 1e-12);
  EXPECT_NEAR(score_of({half}).value, -kFailure - (1 - kFailure) * 0.5, 1e-12);
  EXPECT_NEAR(score_of({touching}).value, -kFailure - (1 - kFailure) * 0.75, 1e-12);
  const CardScore both = score_of({half, no_drive, line("stroke", 0.1, 0.05, Bound::at_most)});
  EXPECT_NEAR(both.value, score_of({half}).value + score_of({no_drive}).value, 1e-12);
  EXPECT_EQ(both.key, "static_margin");
  // Whatever fails is worse than the least that passes, and nearer is better.
  EXPECT_LT(score_of({line("thickness_mm", 2, 1.9999)}).value, 0);
  EXPECT_GT(score_of({line("thickness_mm", 2, 1.9)}).value, score_of({half}).value);
}

TEST(CardScore, ALabelLosesItsConditions) {
  EXPECT_EQ(short_label("Static margin over hinge friction, down to 1°, bending panels"),
            "Static margin over hinge friction");
  EXPECT_EQ(short_label("Panel mass"), "Panel mass");
}

}  // namespace
}  // namespace misalign::search
