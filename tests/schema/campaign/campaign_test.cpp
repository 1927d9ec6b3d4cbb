// Campaign files: what makes a campaign the same or another one, and what is refused at the door.
#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>

#include "schema/campaign/campaign_file.hpp"
#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

std::string xxh3_hex(const std::string& bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

// The paper's perforation, counted off the figure: inner panels whose row + column is odd.
const char* const kHolesOdd = "[[1,2],[1,4],[2,1],[2,3],[3,2],[3,4],[4,1],[4,3]]";

TEST(Identity, IsTheHashOfWhatIsNotDefault) {
  struct Case {
    const char *patch, *sorted;
  };
  constexpr Case kCases[] = {
      {"{}", "{}"},
      {R"({"seed": 2})", R"({"seed":2})"},
      {R"({"accept": {"deploys_from_deg": 150}})", R"({"accept":{"deploys_from_deg":150.0}})"},
      {R"({"accept": {"between_samples": false}})", "{}"},
      {R"({"accept": {"between_samples": true}})", R"({"accept":{"between_samples":true}})"},
      {R"({"accept": {"between_samples": "exact"}})", R"({"accept":{"between_samples":"exact"}})"},
      {R"({"accept": {"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 5}})",
       R"({"accept":{"stop_stiffness_mm2_per_rad2":5.0,"stops_at_deg":60.0}})"},
      {R"({"accept": {"stops_at_deg": null, "stop_stiffness_mm2_per_rad2": null}})", "{}"},
      {R"({"accept": {"by": "diagonals"}})", "{}"},
      {R"({"accept": {"by": "energy"}})",
       R"({"accept":{"by":"energy","fill":{"kind":"springs","preload_n":0.0,"pull_only":false,)"
       R"("stiffness_n_per_mm":50.0}}})"},
      {R"({"accept": {"by": "energy", "fill": {"kind": "plate", "prestretch": 1.1},
          "least_friction_n_mm_per_mm": 0.5}})",
       R"({"accept":{"by":"energy","fill":{"kind":"plate","prestretch":1.1,"shear_mpa":0.5,)"
       R"("thickness_mm":1.0},"least_friction_n_mm_per_mm":0.5}})"},
      {R"({"search": {"method": "plain", "levels_deg": "auto", "particles": 1000}})", "{}"},
      {R"({"search": {"method": "splitting"}})", R"({"search":{"method":"splitting"}})"},
      {R"({"search": {"method": "splitting", "levels_deg": [150, 165], "sweeps": 3}})",
       R"({"search":{"levels_deg":[150.0,165.0,170.0],"method":"splitting","sweeps":3}})"},
      {R"({"seed": 0, "misalignment": {"vertices": "ring", "levels": "uniform"}})",
       R"({"misalignment":{"levels":"uniform","vertices":"ring"},"seed":0})"},
      {R"({"pattern": {"rows": 4, "zigzag_offset_mm": 30}})",
       R"({"pattern":{"rows":4,"zigzag_offset_mm":30.0}})"},
  };
  for (const Case& c : kCases) EXPECT_EQ(identity(read(with(c.patch))), xxh3_hex(c.sorted));
}

TEST(Identity, DoesNotDependOnHowTheCampaignIsWritten) {
  const std::string paper = identity(default_campaign());
  std::string interior;  // rows and columns 1 to 5 of 7, counted from 0; backwards
  for (int v = 5 * 7 + 5; v >= 0; --v) {
    if (v / 7 < 1 || v % 7 < 1 || v % 7 > 5) continue;
    interior += (interior.empty() ? "\"A" : ", \"A") + std::to_string(v + 1) + "\"";
  }
  const std::vector<std::string> same = {
      R"({"name": "other"})",
      R"({"stop": {"draws": 5, "accepted": 7, "wall_s": 1.5}})",
      R"({"stop": {"draws": null}})",
      R"({"actuators": {"stiffness_n_per_mm": 3, "stroke_limit": 0.08}})",
      R"({"design": {"from_deg": 140, "springs": {"stiffness_n_per_mm": 2}, "miscut_mm": 0.05}})",
      R"({"certify": true})",
      R"({"misalignment": {"amplitude_mm": 0.4, "levels": "ternary", "vertices": "interior"}})",
      R"({"path": {"sample_deg": 1.0, "end_deg": 180}, "accept": {"deploys_from_deg": 170.0}})",
      R"({"seed": 1, "pattern": {"panel_width_mm": 80.0, "panel_height_mm": 8e1}})",
      R"({"pattern": {"zigzag_offset_mm": 40, "holes": "checkerboard-odd"}})",
      std::string(R"({"pattern": {"holes": )") + kHolesOdd + "}}",
      R"({"pattern": {"holes": [[4,3],[4,1],[3,4],[3,2],[2,3],[2,1],[1,4],[1,2]]}})",
      R"({"misalignment": {"vertices": [)" + interior + "]}}",
  };
  for (const std::string& patch : same) {
    EXPECT_EQ(identity(read(with(patch.c_str()))), paper) << patch;
  }
  // Sorting keys is what a parser does anyway; the file's order must not come back through it.
  EXPECT_EQ(identity(read(Json::parse(
                R"({"pattern": {"columns": 6, "rows": 4, "family": "miura"}, "seed": 3})"))),
            identity(read(Json::parse(
                R"({"seed": 3, "pattern": {"family": "miura", "rows": 4, "columns": 6}})"))));
}

TEST(Identity, ChangesWithWhatChangesAnAnswer) {
  const char* const kDifferent[] = {
      "{}",
      R"({"seed": 2})",
      R"({"seed": 9223372036854775807})",
      R"({"misalignment": {"amplitude_mm": 0.5}})",
      R"({"misalignment": {"amplitude_mm": 0.4000000000000001}})",
      R"({"misalignment": {"levels": "uniform"}})",
      R"({"misalignment": {"vertices": "ring"}})",
      R"({"misalignment": {"vertices": ["A9"]}})",
      R"({"misalignment": {"vertices": ["A10"]}})",
      R"({"accept": {"deploys_from_deg": 150}})",
      R"({"accept": {"between_samples": true}})",
      R"({"accept": {"between_samples": "exact"}})",
      R"({"accept": {"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 5}})",
      R"({"accept": {"by": "energy"}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "springs", "stiffness_n_per_mm": 40}}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "springs", "preload_n": 1}}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "springs", "pull_only": true}}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "plate"}}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "plate", "prestretch": 1.1}}})",
      R"({"accept": {"by": "energy", "least_friction_n_mm_per_mm": 1}})",
      R"({"accept": {"by": "energy", "least_moment_n_mm": 1}})",
      R"({"path": {"sample_deg": 2}})",
      R"({"search": {"method": "splitting"}})",
      R"({"search": {"method": "splitting", "particles": 999}})",
      R"({"search": {"method": "splitting", "sweeps": 9}})",
      R"({"search": {"method": "splitting", "first_draws": 9}})",
      R"({"search": {"method": "splitting", "levels_deg": [150]}})",
      R"({"path": {"end_deg": 175}})",
      R"({"pattern": {"holes": "checkerboard-even"}})",
      R"({"pattern": {"rows": 4}})",
      R"({"pattern": {"columns": 4}})",
      R"({"pattern": {"panel_width_mm": 81}})",
      R"({"pattern": {"panel_height_mm": 81}})",
      R"({"pattern": {"zigzag_offset_mm": 41}})",
  };
  std::map<std::string, std::string> seen;
  for (const char* patch : kDifferent) {
    const auto [at, is_new] = seen.try_emplace(identity(read(with(patch))), patch);
    EXPECT_TRUE(is_new) << patch << " is the same as " << at->second;
  }
}

// With the threshold there are 256 at most.
TEST(Search, LevelsAreCountedWithTheThreshold) {
  std::vector<double> levels_deg;
  for (int k = 0; k < 256; ++k) levels_deg.push_back(100 + 0.25 * k);  // the last at 163.75
  const auto of = [&] {
    Json value = with("{}");
    value["search"] = {{"method", "splitting"}, {"levels_deg", levels_deg}};
    return read(value);
  };
  EXPECT_THROW(of(), UserError);
  levels_deg.pop_back();
  EXPECT_EQ(of().search.splitting->levels_deg.size(), 256u);
}

// All faults of a splitting search at once.
TEST(Search, WhatCannotBeIsSaid) {
  constexpr std::pair<const char*, const char*> kSaid[] = {
      {R"({"levels_deg": [160, 160]})", "does not lie above 160"},
      {R"({"levels_deg": [160, 150]})", "does not lie above 160"},
      {R"({"levels_deg": [160, 160.0009]})", "is the same level as 160: levels lie a 1024th of a"},
      {R"({"levels_deg": [160, 171]})", "lies above accept.deploys_from_deg = 170"},
      {R"({"particles": 1})", "must be at least 2"},
      {R"({"particles": 1000000, "sweeps": 100})", "more than a population has numbers for"},
      {R"({"method": "plain"})", "has no levels, particles, sweeps or first draws"}};
  for (const auto& [search, said] : kSaid) {
    Json value = with("{}");
    value["search"] = {{"method", "splitting"}, {"sweeps", 9u}};
    value["search"].update(Json::parse(search));
    try {
      read(value);
      ADD_FAILURE() << search;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

TEST(CampaignJson, RoundTripGivesTheSameCampaign) {
  const char* const kCampaigns[] = {
      "{}",
      R"({"name": "x", "seed": 9223372036854775807,
          "misalignment": {"amplitude_mm": 0.1234567890123456789}})",
      R"({"pattern": {"rows": 4, "columns": 8, "holes": "checkerboard-even"}})",
      R"({"misalignment": {"vertices": ["A41", "A1", "A17"], "levels": "uniform"}})",
      R"({"path": {"sample_deg": 0.3, "end_deg": 150}, "accept": {"deploys_from_deg": 120.3}})",
      R"({"stop": {"draws": null, "accepted": 3, "wall_s": 0.5}})",
      R"({"search": {"method": "splitting", "levels_deg": [150.5, 165]},
          "stop": {"populations": null}})",
      R"({"accept": {"between_samples": true}})",
      R"({"accept": {"between_samples": "exact"}})",
      R"({"accept": {"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 5}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "springs", "preload_n": 2, "pull_only": true},
          "least_friction_n_mm_per_mm": 1, "least_moment_n_mm": 0.1}})",
      R"({"accept": {"by": "energy", "fill": {"kind": "plate", "prestretch": 1.1}}})",
      R"({"stop": {"draws": 9223372036854775807, "accepted": 0, "wall_s": null}})",
      R"({"design": {"from_deg": 140, "springs": {"stiffness_n_per_mm": 2}, "miscut_mm": 0.05}})",
      R"({"certify": true})",
  };
  for (const char* patch : kCampaigns) {
    const Campaign campaign = read(with(patch));
    const Json json = campaign_json(campaign);
    const Campaign again = read(Json::parse(json.dump()));  // through text, as a catalogue keeps it
    EXPECT_EQ(campaign_json(again), json);
    EXPECT_EQ(identity(again), identity(campaign));
    EXPECT_EQ(again.misalignment.vertices, campaign.misalignment.vertices);
    EXPECT_EQ(again.misalignment.amplitude_mm, campaign.misalignment.amplitude_mm);
    EXPECT_EQ(again.pattern.base.holes, campaign.pattern.base.holes);
    EXPECT_EQ(again.stop.draws, campaign.stop.draws);
    EXPECT_EQ(again.stop.accepted, campaign.stop.accepted);
    EXPECT_EQ(again.certify, campaign.certify);
  }
}

TEST(Campaign, ReadsWhatIsWritten) {
  const Campaign c = read(with(R"({"name": "n", "seed": 5,
      "pattern": {"rows": 4, "columns": 8, "holes": [[1,2],[1,4],[1,6],[2,1],[2,3],[2,5]]},
      "misalignment": {"vertices": ["A13", "A11"], "amplitude_mm": 0.25, "levels": "uniform"},
      "path": {"sample_deg": 0.5, "end_deg": 120}, "accept": {"deploys_from_deg": 90},
      "stop": {"draws": 10, "accepted": 2, "wall_s": 3}})"));
  EXPECT_EQ(c.name, "n");
  EXPECT_EQ(c.seed, 5u);
  EXPECT_EQ(c.pattern.base.holes, (std::vector<int>{10, 12, 14, 17, 19, 21}));
  EXPECT_EQ(c.misalignment.vertices, (std::vector<int>{10, 12}));
  EXPECT_EQ(c.misalignment.amplitude_mm, 0.25);
  EXPECT_EQ(c.misalignment.distribution, ShiftDistribution::uniform);
  EXPECT_EQ(c.threshold_sample(), 180);
  EXPECT_EQ(c.path().end_deg, 120);
  EXPECT_EQ(c.stop.draws, 10u);
  EXPECT_EQ(c.stop.accepted, 2u);
  EXPECT_EQ(c.stop.wall_s, 3.0);
}

TEST(Campaign, CertifiesAsItGoesOnlyWherePlainDrawsAreMade) {
  EXPECT_FALSE(read(with("{}")).certify);
  EXPECT_TRUE(read(with(R"({"certify": true})")).certify);
  EXPECT_FALSE(stored_configuration(read(with("{}"))).contains("certify"));
  EXPECT_FALSE(read(with(R"({"certify": false, "search": {"method": "splitting"}})")).certify);
  const auto faults = faults_of(with(R"({"certify": true, "search": {"method": "splitting"}})"));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("misalign certify"), std::string::npos) << faults[0];
}

TEST(Faults, AreAllReportedAtOnce) {
  const auto faults = faults_of(with(R"({"name": "a b", "seed": -1, "extra": 1,
      "misalignment": {"levels": "many"}, "path": {"sample_deg": 1000}, "stop": {"draws": "all"},
      "pattern": {"rows": 2, "columns": "six"}})"));
  const char* const kNamed[] = {"name",
                                "pattern.rows",
                                "pattern.columns",
                                "misalignment.levels",
                                "path.sample_deg",
                                "seed",
                                "stop.draws",
                                "extra"};
  EXPECT_EQ(faults.size(), std::size(kNamed));
  for (const char* key : kNamed) {
    // Each as "problem (why); suggestion".
    EXPECT_EQ(std::count_if(faults.begin(), faults.end(),
                            [&](const std::string& sentence) {
                              return sentence.rfind(key, 0) == 0 &&
                                     sentence.find(" (") != std::string::npos &&
                                     sentence.find("); ") != std::string::npos;
                            }),
              1)
        << key;
  }
  const auto four = faults_of(with(R"({"seed": 1.5, "stop": {"accepted": -2},
      "misalignment": {"amplitude_mm": 0}, "accept": {"deploys_from_deg": 200}})"));
  EXPECT_EQ(four.size(), 4u);
}

// The bound needs a sheet, not the absence of faults elsewhere.
TEST(Faults, AFaultElsewhereHidesNoOther) {
  EXPECT_EQ(faults_of(with(R"({"name": "a b", "misalignment": {"amplitude_mm": 45}})")).size(), 2u);
  EXPECT_EQ(
      faults_of(with(R"({"path": {"extra": 1}, "accept": {"deploys_from_deg": 150.5}})")).size(),
      2u);
  EXPECT_EQ(
      faults_of(with(R"({"pattern": {"extra": 1}, "misalignment": {"vertices": "most"}})")).size(),
      2u);
}

TEST(Faults, OfFiles) {
  for (const char* path : {"/nowhere/campaign.json", MISALIGN_SOURCE_DIR "/schema/catalogue.sql",
                           MISALIGN_SOURCE_DIR, "/dev/zero"}) {
    try {
      read_campaign_file(path);
      ADD_FAILURE() << path;
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_input);
      EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
    }
  }
}

// A sentence goes on behind a text that would end it, or move a terminal's cursor.
TEST(Faults, ControlCharactersAreShown) {
  const std::string odd("a\0b\x1b[2J", 7), shown = "a\\u0000b\\u001b[2J";
  expect_fault(with(Json{{odd, 1}}), {shown + " (is not a key here)"});
  const auto refusal = [](const auto& read) -> std::string {
    try {
      read();
      return "accepted";
    } catch (const UserError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal([&] { read_json_file(odd); }).find(shown + ": cannot be opened"), 0u);
  const std::string twice = "{" + Json(odd).dump() + ":1," + Json(odd).dump() + ":2}";
  EXPECT_EQ(refusal([&] { parse_json(twice, "test"); }).find("test: " + shown + " occurs twice"),
            0u);
}

TEST(Campaign, AnglesAreWholeMultiplesOfTheSample) {
  struct Case {
    double sample_deg, end_deg, threshold_deg;
    const char* key;  // of the fault; null if it is good
  };
  constexpr Case kCases[] = {
      {1, 180, 150, nullptr},
      {0.1, 180, 170.3, nullptr},  // 1703 * 0.1 is not 170.3 in double
      {0.01, 179.99, 0.01, nullptr},
      {60, 180, 180, nullptr},
      {7, 175, 7, nullptr},
      {7, 180, 7, "path.end_deg"},
      {1, 180, 150.5, "accept.deploys_from_deg"},
      {1, 180, 150.0001, "accept.deploys_from_deg"},
      {60, 180, 0.01, "accept.deploys_from_deg"},
      {1, 150, 151, "accept.deploys_from_deg"},  // beyond the end
  };
  for (const Case& c : kCases) {
    const Json value = with(Json{{"path", {{"sample_deg", c.sample_deg}, {"end_deg", c.end_deg}}},
                                 {"accept", {{"deploys_from_deg", c.threshold_deg}}}});
    if (c.key) {
      expect_fault(value, {c.key});
    } else {
      EXPECT_TRUE(faults_of(value).empty()) << value;
    }
  }
}

TEST(Campaign, RefusesDisplacements) {
  for (const char* shifts : {"{}", R"({"A10": [0.4, 0]})", "3"}) {
    expect_fault(with(Json{{"pattern", {{"displacements_mm", Json::parse(shifts)}}}}),
                 {"pattern.displacements_mm", "draws its own"});
  }
}

}  // namespace
}  // namespace misalign::schema
