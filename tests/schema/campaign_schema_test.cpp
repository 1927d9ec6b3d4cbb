// campaign.schema.json has the keys, the defaults and the goals of the code, and accepts its files.
#include "schema/campaign/campaign_file.hpp"
#include "tests/schema/schema_agreement.hpp"

namespace misalign::schema {
namespace {

TEST(SchemaFiles, DescribeEveryKeyAndRefuseEveryOther) {
  for (const Json& schema : {campaign_schema(), candidate_schema(), material_schema()}) {
    walk(schema, [](const Pointer& at, const Json& part) {
      if (!part.is_object()) return;
      // Conditions on keys that are described.
      if (at.to_string().starts_with("/dependencies")) return;
      if (at.to_string().find("/not") != std::string::npos) return;
      if (part.contains("properties")) {
        EXPECT_EQ(part.value("additionalProperties", true), false) << at;
      }
      if (!at.empty() && at.back() == "properties") {
        for (const auto& [key, child] : part.items()) {
          EXPECT_FALSE(child.value("description", "").empty()) << at / key;
        }
      }
    });
  }
}

TEST(CampaignSchema, HasTheKeysAndDefaultsOfTheCode) {
  const Json defaults = campaign_json(default_campaign());
  const auto properties = properties_of(campaign_schema());
  std::set<std::string> schema_keys;
  const std::set<std::string> required = {"/pattern/family", "/pattern/rows", "/pattern/columns"};
  // Of the other family, or left out where the usual is meant.
  const std::set<std::string> not_in_default = {
      "/pattern/file", "/pattern/mesh", "/pattern/mm_per_unit", "/pattern/pilot",
      "/pattern/target_frame", "/pattern/target_file", "/pattern/springs",
      "/pattern/springs/attach",
      // design.fill replaces design.springs.
      "/design/fill",
      // Hinges without a name have none.
      "/design/hinges/like", "/design/hinges/name",
      // The older name of design.springs.
      "/actuators", "/actuators/stiffness_n_per_mm", "/actuators/stroke_limit",
      "/actuators/preload_n", "/actuators/largest_force_n"};
  for (const auto& [at, property] : properties) {
    if (not_in_default.contains(at)) continue;
    schema_keys.insert(at);
    ASSERT_TRUE(defaults.contains(Pointer(at))) << at;
    const bool optional_leaf = !property.contains("properties") && !required.contains(at);
    ASSERT_EQ(property.contains("default"), optional_leaf) << at;
    if (optional_leaf) {
      EXPECT_EQ(property["default"], defaults[Pointer(at)]) << at;
    }
  }
  EXPECT_EQ(schema_keys, keys_of(defaults));
}

TEST(CampaignSchema, DefaultsAreWhatTheCodeFillsIn) {
  const Json defaults = campaign_json(default_campaign());
  for (const auto& [at, property] : properties_of(campaign_schema())) {
    if (!property.contains("default") || !defaults.contains(Pointer(at))) continue;
    const Json shorter = without(defaults, Pointer(at));
    EXPECT_EQ(complaint(campaign_schema(), shorter), "") << at;
    EXPECT_EQ(campaign_json(read_campaign(shorter, at)), defaults) << at;
  }
}

TEST(CampaignSchema, AcceptsTheDefaultAndEveryShippedFile) {
  EXPECT_EQ(complaint(campaign_schema(), campaign_json(default_campaign())), "");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(MISALIGN_SOURCE_DIR) +
                                                               "/search/campaigns")) {
    if (entry.path().extension() != ".json") continue;
    ++files;
    EXPECT_EQ(complaint(campaign_schema(), read_json_file(entry.path())), "") << entry.path();
    const Campaign campaign = read_campaign_file(entry.path());
    EXPECT_EQ(campaign.name, entry.path().stem());
    EXPECT_EQ(complaint(campaign_schema(), campaign_json(campaign)), "") << entry.path();
  }
  EXPECT_GE(files, 3);
}

// As what is maximised and as a limit: those of campaigns, and no others.
TEST(CampaignSchema, KnowsTheGoals) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const solver::Goal& goal : solver::goal_table()) {
    const std::string name(goal.name),
        other = goal.unit == std::string("mm") ? "energy_n_mm" : "miscut_margin_mm";
    for (const Json& keys : {Json{{"maximise", name}},
                             Json{{"maximise", other}, {"subject_to", {name + " >= 0.1"}}}}) {
      Json search = {{"method", "optimise"}, {"from_deg", 36}};
      search.update(keys);
      const Json value = with(good, "/search", search);
      EXPECT_EQ(complaint(schema, value).empty(), goal.is_same_everywhere) << value["search"];
      EXPECT_EQ(refusal(value).empty(), goal.is_same_everywhere) << value["search"];
    }
  }
}

}  // namespace
}  // namespace misalign::schema
