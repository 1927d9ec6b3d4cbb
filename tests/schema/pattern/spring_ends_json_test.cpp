// "springs" of patterns: what is read, what is written again, what is refused.
#include "schema/pattern/spring_ends_json.hpp"

#include "schema/pattern/pattern_file.hpp"
#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

Json attached(const char* attach) {
  return with(Json{{"pattern", {{"springs", {{"attach", Json::parse(attach)}}}}}});
}

TEST(SpringEndsJson, IsReadAndWrittenAgain) {
  const Campaign campaign = read(attached(R"({"inset_mm": 6.5, "offset_mm": -1})"));
  EXPECT_EQ(campaign.pattern.base.springs.inset_mm, 6.5);
  EXPECT_EQ(campaign.pattern.base.springs.offset_mm, -1);
  const Campaign again = read(campaign_json(campaign));
  EXPECT_EQ(campaign_json(again), campaign_json(campaign));
}

// A point of table 1's holes: one end stands elsewhere, and is written as it is read.
Json with_points(const char* points) {
  return attached((R"({"inset_mm": 6, "points": )" + std::string(points) + "}").c_str());
}

TEST(SpringEndsJson, PointsAreReadAndWrittenAgain) {
  const Json document = with_points(
      R"([{"hole": [1, 2], "vertex": "A10", "panel": [0, 1], "from_vertex_mm": [8, -1.5, 0.25]}])");
  const Campaign campaign = read(document);
  const auto& own = campaign.pattern.base.springs.own;
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].hole, 8);
  EXPECT_EQ(own[0].vertex, 9);
  EXPECT_EQ(own[0].panel, 1);
  EXPECT_EQ(own[0].place_mm, Eigen::Vector3d(8, -1.5, 0.25));
  EXPECT_FALSE(campaign.pattern.base.springs.in_mid_plane());
  const Json again = campaign_json(campaign);
  EXPECT_EQ(again.at("pattern").at("springs").at("attach").at("points"),
            document.at("pattern").at("springs").at("attach").at("points"));
  EXPECT_EQ(campaign_json(read(again)), again);
  EXPECT_NE(identity_json(campaign), identity_json(read(attached(R"({"inset_mm": 6})"))));
}

TEST(SpringEndsJson, PointsThatCannotBeAreRefused) {
  const std::string key = "pattern.springs.attach.points";
  expect_fault(with_points("7"), {key, "must be a list"});
  expect_fault(with_points(R"([{"hole": [1, 2], "vertex": "A10", "panel": [0, 1]}])"),
               {key + "[0].from_vertex_mm", "is missing"});
  const auto point = [](const char* hole, const char* vertex, const char* panel,
                        const char* place) {
    return "{\"hole\": " + std::string(hole) + ", \"vertex\": \"" + vertex +
           "\", \"panel\": " + panel + ", \"from_vertex_mm\": " + place + "}";
  };
  const auto refused = [&](const std::string& one, const std::vector<std::string>& words) {
    expect_fault(with_points(("[" + one + "]").c_str()), words);
  };
  refused(point("[1, 1]", "A10", "[0, 1]", "[8, 0, 0]"), {key + "[0].hole", "is no hole"});
  refused(point("[1, 2]", "A1", "[0, 1]", "[8, 0, 0]"), {key + "[0].vertex", "A10, A11, A18, A17"});
  refused(point("[1, 2]", "A10", "[3, 3]", "[8, 0, 0]"), {key + "[0].panel", "[0,1], [0,2]"});
  refused(point("[1, 2]", "A10", "[0, 1]", "[8, 0]"), {key, "must be three numbers"});
  refused(point("[1, 2]", "A10", "[0, 1]", "[-8, 0, 0]"),
          {"attach", "lies outside the panel [0,1]"});
  const std::string good = point("[1, 2]", "A10", "[0, 1]", "[8, 0, 0]");
  refused(good + ", " + good, {key + "[1]", "repeats a spring's end"});
}

// What says nothing is the paper's sheet, and leaves its campaigns what they are.
TEST(SpringEndsJson, VerticesAreNoOtherCampaign) {
  const Json plain = identity_json(read(minimal()));
  for (const char* attach : {R"("vertices")", "{}", R"({"inset_mm": 0, "offset_mm": 0})"}) {
    EXPECT_EQ(identity_json(read(attached(attach))), plain) << attach;
  }
  EXPECT_NE(identity_json(read(attached(R"({"inset_mm": 6})"))), plain);
}

TEST(SpringEndsJson, WhatCannotBeIsRefused) {
  const char* const key = "pattern.springs.attach";
  expect_fault(attached("7"), {key, "is no place of springs' ends"});
  expect_fault(attached(R"({"inset_mm": -1})"), {key, "inset_mm"});
  expect_fault(attached(R"({"inset_mm": 500})"), {key, "lies outside the panel"});
  expect_fault(attached(R"({"inset": 5})"), {key, "the keys are inset_mm, offset_mm, points"});
  Json exact = attached(R"({"offset_mm": 1})");
  exact["accept"]["between_samples"] = "exact";
  expect_fault(exact, {"accept.between_samples", "off the mid-plane"});
  Json certified = attached(R"({"offset_mm": 1})");
  certified["certify"] = true;
  expect_fault(certified, {"certify", "in the panels' mid-plane"});
  Json few = attached(R"({"inset_mm": 6})");
  few["pattern"]["holes"] = Json::parse("[[1, 2]]");
  few["misalignment"] = {{"kind", "parallel"}, {"vertices", "all"}};
  expect_fault(few, {key, "overconstrained"});
}

}  // namespace
}  // namespace misalign::schema
