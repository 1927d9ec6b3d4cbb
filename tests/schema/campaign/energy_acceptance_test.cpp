// Acceptance by energy: its criterion, what it excludes, and what is stored of campaigns without
// it.
#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

TEST(EnergyAcceptance, GivesTheSolverItsCriterion) {
  EXPECT_FALSE(read(with("{}")).criterion().energy);
  const Campaign campaign = read(with(R"({"path": {"sample_deg": 0.5},
      "accept": {"by": "energy", "deploys_from_deg": 150, "least_friction_n_mm_per_mm": 0.7,
                 "fill": {"kind": "plate", "shear_mpa": 0.4, "thickness_mm": 2}}})"));
  const auto energy = campaign.criterion().energy;
  ASSERT_TRUE(energy);
  EXPECT_EQ(energy->from_sample, 300);
  EXPECT_EQ(energy->least_friction_n_mm_per_mm, 0.7);
  EXPECT_EQ(energy->least_moment_n_mm, 0);
  const auto* const plates = std::get_if<solver::RubberPlates>(&energy->fill);
  ASSERT_TRUE(plates);
  EXPECT_EQ(plates->shear_mpa, 0.4);
  EXPECT_EQ(plates->thickness_mm, 2);
  EXPECT_EQ(plates->prestretch, 1);
  ASSERT_TRUE(campaign.sampling().energy_of);
}

// A catalogue that judges diagonals can still be read by programs that know no others.
TEST(EnergyAcceptance, IsStoredOnlyWhereItJudges) {
  const Json diagonals = stored_configuration(read(with("{}")))["accept"];
  const Json energy = stored_configuration(read(with(R"({"accept": {"by": "energy"}})")))["accept"];
  for (const char* key : {"by", "fill", "least_friction_n_mm_per_mm", "least_moment_n_mm"}) {
    EXPECT_FALSE(diagonals.contains(key)) << key;
    EXPECT_TRUE(energy.contains(key)) << key;
  }
}

// Every way to say the same filling.
TEST(EnergyAcceptance, TheSameFillingHasOneIdentity) {
  const auto identity_of = [](const char* fill) {
    Json campaign = with(R"({"accept": {"by": "energy"}})");
    campaign["accept"]["fill"] = Json::parse(fill);
    return identity(read(campaign));
  };
  const std::string springs = identity_of(R"({"kind": "springs"})");
  EXPECT_EQ(springs, identity_of(R"({"kind": "springs", "preload_n": -0.0})"));
  EXPECT_EQ(springs, identity_of(R"({"kind": "springs", "rest_deg": 0, "on": "all",
                                     "preloads_n": null, "single": []})"));
  EXPECT_NE(springs, identity_of(R"({"kind": "springs", "preload_n": 1})"));
  EXPECT_EQ(identity_of(R"({"kind": "plate"})"),
            identity_of(R"({"kind": "plate", "rest_deg": -0.0, "cut_outs": []})"));
}

TEST(EnergyAcceptance, WhatCannotBeIsSaid) {
  constexpr std::pair<const char*, const char*> kSaid[] = {
      {R"({"accept": {"fill": {"kind": "plate"}}})", "accept.fill (is for sheets that are judged"},
      // Keys of a criterion with a typing error are not blamed.
      {R"({"accept": {"by": "enrgy", "fill": {"kind": "plate"}, "least_moment_n_mm": 1}})",
       "accept.by"},
      {R"({"accept": {"least_friction_n_mm_per_mm": 1}})", "judged by energy"},
      {R"({"accept": {"least_moment_n_mm": 1}})", "judged by energy"},
      {R"({"accept": {"by": "energy", "between_samples": "exact"}})", "accept.between_samples"},
      {R"({"accept": {"by": "energy", "stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 5}})",
       "accept.stops_at_deg"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "plate"}}, "certify": true})",
       "certify = true (plates without pre-stretch wrinkle"},
      {R"({"accept": {"by": "energy"}, "search": {"method": "optimise", "from_deg": 36}})",
       "search.method"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "none"}}})", "nothing drives the sheet"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "springs", "rest_deg": 60}}})",
       "relaxed flat and equal in all holes"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "springs", "preloads_n": {"A11-A17": 2}}}})",
       "relaxed flat and equal in all holes"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "springs", "on": "one_a_hole"}}})",
       "relaxed flat and equal in all holes"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "springs", "stroke_limit": 0.1}}})",
       "changes no energy"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "plate"}},
           "pattern": {"springs": {"attach": {"inset_mm": 6}}}})",
       "bonded to the holes' edges"}};
  for (const auto& [patch, said] : kSaid) {
    const auto faults = faults_of(with(patch));
    ASSERT_EQ(faults.size(), 1u) << patch;
    EXPECT_NE(faults[0].find(said), std::string::npos) << faults[0];
  }
  EXPECT_TRUE(faults_of(with(R"({"accept": {"by": "energy"}, "search": {"method": "splitting"}})"))
                  .empty());
  EXPECT_TRUE(faults_of(with(R"({"accept": {"by": "energy"},
      "pattern": {"springs": {"attach": {"inset_mm": 6}}}})"))
                  .empty());
  // Keys of a design's filling with values that change nothing, and every key that does.
  EXPECT_TRUE(faults_of(with(R"({"accept": {"by": "energy", "fill": {"kind": "springs",
      "rest_deg": 0, "on": "all", "preloads_n": {}, "single": null, "stroke_limit": null}}})"))
                  .empty());
  EXPECT_EQ(faults_of(with(R"({"accept": {"by": "energy", "fill": {"kind": "springs",
      "rest_deg": 60, "on": "one_a_hole"}}})"))
                .size(),
            2u);
  // All faults of a filling at once.
  EXPECT_EQ(faults_of(with(R"({"accept": {"by": "energy", "fill": {"kind": "springs",
      "stiffness_n_per_mm": -1, "preload_n": -1, "stiffnes": 1}}})"))
                .size(),
            3u);
}

}  // namespace
}  // namespace misalign::schema
