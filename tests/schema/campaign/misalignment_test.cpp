// How a campaign says that vertices are shifted: within which bound, each by itself or together.
#include "schema/campaign/misalignment.hpp"

#include <algorithm>
#include <random>

#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

Json with_amplitude(double amplitude_mm, const char* vertices = "interior") {
  return with(Json{{"misalignment", {{"amplitude_mm", amplitude_mm}, {"vertices", vertices}}}});
}

// A corner whose two sides have the base w along x and (o, h) and whose three vertices move turns
// by (w - 2a)(h - 2a) - 2a(o + 2a) at worst: with w = h = 80 and o = 40 that is 6400 - 400 a.
constexpr double kSafe_mm = 16;
// The search for the bound stops at 1e-6 panel widths, on the safe side.
constexpr double kSearch_mm = 1e-6 * 80;

TEST(Amplitude, IsRefusedFromTheBoundOn) {
  for (const char* vertices : {"interior", "ring"}) {
    EXPECT_TRUE(faults_of(with_amplitude(kSafe_mm - 2 * kSearch_mm, vertices)).empty());
    expect_fault(with_amplitude(kSafe_mm, vertices), {"misalignment.amplitude_mm", "convexity"});
  }
  const auto faults = faults_of(with_amplitude(45));
  ASSERT_EQ(faults.size(), 1u);
  const std::string words = "amplitude_mm = 45 (must be below ";
  const std::size_t at = faults[0].find(words);
  ASSERT_NE(at, std::string::npos) << faults[0];
  const double told = std::stod(faults[0].substr(at + words.size()));
  EXPECT_LE(told, kSafe_mm);        // what is told to be allowed is allowed
  EXPECT_GE(told, 0.9 * kSafe_mm);  // and, being told in two digits, not much less than what is
}

TEST(Amplitude, ToldBoundIsTheBound) {
  expect_fault(with_amplitude(45), {"must be below 16,"});  // the contract's and the house's words
}

// Near what was asked for: round, taken by who reads it, and not a fraction of what is possible.
TEST(Amplitude, SuggestionIsTakenAndNear) {
  for (const char* pattern :
       {R"({})", R"({"panel_width_mm": 30, "panel_height_mm": 20, "zigzag_offset_mm": 10})",
        R"({"panel_width_mm": 1000, "panel_height_mm": 1000, "zigzag_offset_mm": 500})",
        R"({"rows": 4, "columns": 4, "panel_width_mm": 7, "zigzag_offset_mm": 3})"}) {
    SCOPED_TRACE(pattern);
    Json value = with_amplitude(900);
    value["pattern"].update(Json::parse(pattern));
    const auto faults = faults_of(value);
    ASSERT_EQ(faults.size(), 1u);
    const auto number_after = [&](const std::string& words) {
      return std::stod(faults[0].substr(faults[0].find(words) + words.size()));
    };
    const double suggested_mm = number_after("try ");
    EXPECT_GE(suggested_mm, 0.85 * number_after("must be below ")) << faults[0];
    value["misalignment"]["amplitude_mm"] = suggested_mm;
    EXPECT_TRUE(faults_of(value).empty()) << faults[0];
  }
}

TEST(Amplitude, BoundIsRightOnBothSides) {
  const Campaign campaign = default_campaign();
  const solver::CreasePattern& sheet = campaign.pattern.base.sheet;
  for (const auto& shifted : {solver::interior_vertices(sheet), solver::ring_vertices(sheet),
                              std::vector<int>{8}, std::vector<int>{0, 1, 7, 8}}) {
    const double safe_mm = solver::largest_safe_amplitude_mm(sheet, shifted);
    // Below: random corners of the squares, where the least turn is taken, keep every facet convex.
    constexpr unsigned kSeed = 20240611;
    std::mt19937 random(kSeed);
    std::bernoulli_distribution coin;
    int lost = 0;
    for (int trial = 0; trial < 20000; ++trial) {
      solver::FlatVertices vertices_mm = sheet.vertices_mm;
      for (const int v : shifted) {
        for (int axis = 0; axis < 2; ++axis)
          vertices_mm(axis, v) += coin(random) ? safe_mm : -safe_mm;
      }
      lost += !solver::nonconvex_facets(sheet, vertices_mm).empty();
    }
    EXPECT_EQ(lost, 0) << "seed " << kSeed << ", safe " << safe_mm;
    // Above and below: all corners of the squares of one facet at a time.
    const auto some_facet_breaks = [&](double amplitude_mm) {
      for (int f = 0; f < sheet.facet_count(); ++f) {
        for (int signs = 0; signs < 256; ++signs) {
          solver::FlatVertices vertices_mm = sheet.vertices_mm;
          for (int k = 0; k < 4; ++k) {
            const int v = sheet.facets[f][k];
            if (!std::binary_search(shifted.begin(), shifted.end(), v)) continue;
            vertices_mm(0, v) += (signs >> (2 * k) & 1) ? amplitude_mm : -amplitude_mm;
            vertices_mm(1, v) += (signs >> (2 * k + 1) & 1) ? amplitude_mm : -amplitude_mm;
          }
          const auto bad = solver::nonconvex_facets(sheet, vertices_mm);
          if (std::find(bad.begin(), bad.end(), f) != bad.end()) return true;
        }
      }
      return false;
    };
    EXPECT_FALSE(some_facet_breaks(safe_mm)) << safe_mm;
    EXPECT_TRUE(some_facet_breaks(safe_mm + kSearch_mm)) << safe_mm;
  }
  EXPECT_NEAR(solver::largest_safe_amplitude_mm(sheet, solver::interior_vertices(sheet)), kSafe_mm,
              kSearch_mm);
}

TEST(Misalignment, OfTheParallelFamilyIsReadAndWritten) {
  const Campaign campaign =
      read(with(R"({"misalignment": {"kind": "parallel", "vertices": "all", "amplitude_mm": 4}})"));
  ASSERT_TRUE(campaign.misalignment.parallel);
  EXPECT_TRUE(campaign.misalignment.parallel->like_signs);
  EXPECT_EQ(campaign.misalignment.distribution, ShiftDistribution::uniform);
  EXPECT_EQ(campaign.misalignment.vertices.size(), 49u);
  EXPECT_EQ(campaign.end_deg, 179);  // at 180 all creases close
  EXPECT_EQ(identity(read(campaign_json(campaign))), identity(campaign));
  const char* const kOthers[] = {
      R"({"misalignment": {"vertices": "all", "amplitude_mm": 4, "levels": "uniform"}})",
      R"({"misalignment": {"kind": "parallel", "amplitude_mm": 4}})",
      R"({"misalignment": {"kind": "parallel", "vertices": "all", "amplitude_mm": 4,
                           "signs": "free"}})"};
  for (const char* other : kOthers) EXPECT_NE(identity(read(with(other))), identity(campaign));
  EXPECT_EQ(identity(read(with(R"({"misalignment": {"kind": "free"}})"))),
            identity(default_campaign()));
}

TEST(Misalignment, OfTheParallelFamilyIsRefusedWhereItHasNoMeaning) {
  const auto refused = [](const char* patch, const char* key, const char* why) {
    const auto faults = faults_of(with(patch));
    ASSERT_EQ(faults.size(), 1u) << patch;
    EXPECT_EQ(faults[0].rfind(key, 0), 0u) << faults[0];
    EXPECT_NE(faults[0].find(why), std::string::npos) << faults[0];
  };
  refused(R"({"misalignment": {"kind": "parallell"}})", "misalignment.kind", "\"parallel\"");
  refused(R"({"misalignment": {"signs": "free"}})", "misalignment.signs", "parallel");
  refused(R"({"misalignment": {"kind": "parallel", "signs": "any"}})", "misalignment.signs",
          "alike");
  refused(R"({"misalignment": {"kind": "parallel", "levels": "ternary"}})", "misalignment.levels",
          "uniform");
  refused(R"({"misalignment": {"kind": "parallel"}, "search": {"method": "splitting"}})",
          "search.method", "one by one");
  refused(R"({"misalignment": {"kind": "parallel"},
              "search": {"method": "optimise", "from_deg": 36, "starts": "splitting"}})",
          "search.starts", "one by one");
  refused(R"({"misalignment": {"kind": "parallel"}, "path": {"end_deg": 180}})", "path.end_deg",
          "try 179");
  refused(R"({"misalignment": {"kind": "parallel", "vertices": ["A9", "A10"]}})",
          "misalignment.vertices", "\"all\"");
}

}  // namespace
}  // namespace misalign::schema
