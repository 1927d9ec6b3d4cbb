// "springs" of patterns: what is read, what is written again, what is refused.
#include "schema/pattern/spring_ends_json.hpp"

#include "campaign_faults.hpp"
#include "schema/pattern/pattern_file.hpp"

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
  expect_fault(attached("7"), {key, "is no place where springs end"});
  expect_fault(attached(R"({"inset_mm": -1})"), {key, "inset_mm"});
  expect_fault(attached(R"({"inset_mm": 500})"), {key, "lies outside the panel"});
  expect_fault(attached(R"({"inset": 5})"), {key, "the keys are inset_mm, offset_mm"});
  Json exact = attached(R"({"offset_mm": 1})");
  exact["accept"]["between_samples"] = "exact";
  expect_fault(exact, {"accept.between_samples", "off the mid-plane"});
  Json certified = attached(R"({"offset_mm": 1})");
  certified["certify"] = true;
  expect_fault(certified, {"certify", "in the panels' mid-plane"});
  Json few = attached(R"({"inset_mm": 6})");
  few["pattern"]["holes"] = Json::parse("[[1, 2]]");
  few["misalignment"] = {{"kind", "parallel"}, {"vertices", "all"}};
  expect_fault(few, {key, "with so few holes"});
}

}  // namespace
}  // namespace misalign::schema
