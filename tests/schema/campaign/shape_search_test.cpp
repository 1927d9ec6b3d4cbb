// The search method "shape" and its target: keys, identity and faults.
#include "schema/campaign/shape_search.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "schema/pattern/target.hpp"
#include "tests/folder.hpp"
#include "tests/schema/campaign_faults.hpp"

namespace misalign::schema {
namespace {

Json shaping(const Json& search = Json::object(), const Json& beside = Json::object()) {
  Json value = with(R"({"accept": {"deploys_from_deg": 105}, "misalignment": {"vertices": "all"},
                        "target": {"surface": "sphere", "radius_mm": 1440}})");
  value["search"] = {{"method", "shape"}};
  if (!search.is_null()) value["search"].update(search);
  value.update(beside);
  return value;
}

TEST(ShapeSearch, IsReadAndWritten) {
  const Campaign campaign = read(
      shaping({{"shape_max_mm", 0.25}, {"shift_weights", {0.01, 1}}, {"turned_diagonals", 2u}}));
  ASSERT_TRUE(campaign.search.shape);
  EXPECT_FALSE(campaign.search.optimisation || campaign.search.splitting);
  EXPECT_TRUE(campaign.search.stores_sheets() && campaign.search.has_ends());
  EXPECT_EQ(*campaign.search.shape, (ShapeSearch{0.25, {0.01, 1}, 2}));
  EXPECT_EQ(campaign.target->at_deg, 90);
  const Json json = campaign_json(campaign);
  EXPECT_EQ(json["target"], Json({{"surface", "sphere"}, {"radius_mm", 1440.0}, {"at_deg", 90.0}}));
  EXPECT_EQ(campaign_json(read(json)), json);
  EXPECT_EQ(campaign_json(read(stored_configuration(campaign))), json);
  EXPECT_EQ(identity(read(json)), identity(campaign));
}

TEST(ShapeSearch, IsPartOfTheIdentity) {
  std::map<std::string, Json> seen;
  const auto target = [](const Json& patch) {
    Json all = {{"surface", "sphere"}, {"radius_mm", 1440}};
    all.update(patch);
    return Json{{"target", all}};
  };
  for (const Json& value :
       {with("{}"), shaping(), shaping({{"shape_max_mm", 0.5}}),
        shaping({{"shift_weights", {0.02}}}), shaping({{"turned_diagonals", 1u}}),
        shaping({}, target({{"radius_mm", 1441}})), shaping({}, target({{"radius_mm", -1440}})),
        shaping({}, target({{"at_deg", 91}})), shaping({}, target({{"of", "panels"}})),
        shaping({}, target({{"surface", "saddle"}}))}) {
    EXPECT_TRUE(seen.emplace(identity(read(value)), value).second) << value;
  }
  for (const Json& same : {target({{"radius_mm", 1440.0}}), target({{"at_deg", 90}}),
                           target({{"at_deg", nullptr}}), target({{"of", "vertices"}})}) {
    EXPECT_EQ(identity(read(shaping({}, same))), identity(read(shaping()))) << same;
  }
  const Json defaults = {
      {"shape_max_mm", 1}, {"shift_weights", Json::array()}, {"turned_diagonals", 0u}};
  EXPECT_EQ(identity(read(shaping(defaults))), identity(read(shaping())));
}

// A catalogue carries the mesh itself: the stored target reads as the file did, to the last bit.
TEST(ShapeSearch, CarriesAMesh) {
  const Folder folder("campaign_mesh");
  std::string hull;
  constexpr int kSide = 12;
  for (int k = 0; k < kSide * kSide; ++k) {
    const double x = 0.1 + 50 * (k % kSide) - 275, y = 50 * (k / kSide) - 275;
    hull += fmt::format("v {} {} {}\n", x, y, 1e-4 * (x * x - y * y) / 3);
  }
  for (int k = 0; k + kSide < kSide * kSide; ++k) {
    if ((k + 1) % kSide == 0) continue;
    hull += fmt::format("f {} {} {} {}\n", k + 1, k + 2, k + kSide + 2, k + kSide + 1);
  }
  const std::string file = folder.file("hull.obj", hull);
  const Json asked = shaping({}, {{"target", {{"surface", "mesh"}, {"file", file}}}});
  const Campaign campaign = read(asked);
  const Json stored = stored_configuration(campaign);
  EXPECT_FALSE(stored["target"].contains("file"));
  EXPECT_EQ(stored["target"]["points_mm"].size(), std::size_t{kSide * kSide});
  std::filesystem::remove(file);
  const Campaign again = read(Json::parse(stored.dump()));
  EXPECT_EQ(identity(again), identity(campaign));
  EXPECT_EQ(again.target->mesh->vertices_mm, campaign.target->mesh->vertices_mm);
  EXPECT_EQ(again.target->mesh->triangles, campaign.target->mesh->triangles);
  Json turned = stored;
  turned["target"]["points_mm"][7][2] = 0.125;
  EXPECT_NE(identity(read(turned)), identity(campaign));
  turned["target"]["triangles"][0][0] = 1e4;
  EXPECT_NE(faults_of(turned).at(0).find("triples of indices"), std::string::npos);
}

// Other campaigns keep their configuration and identity as they were.
TEST(ShapeSearch, LeavesOthersAlone) {
  for (const Campaign& other : {default_campaign(), read(with(R"({"target": null})"))}) {
    EXPECT_FALSE(stored_configuration(other).contains("target"));
    EXPECT_FALSE(stored_configuration(other).contains("search"));
    EXPECT_FALSE(identity_json(other).contains("target"));
    EXPECT_FALSE(identity_json(other).contains("search"));
  }
}

TEST(ShapeSearch, IsRefusedWithAllFaults) {
  const auto of = [](const Json& value) { return faults_of(value); };
  EXPECT_EQ(of(shaping({{"shape_max_mm", 0}, {"shift_weights", {0}}, {"turned_diagonals", -1}},
                       {{"target", {{"surface", "torus"}}}}))
                .size(),
            4u);
  const auto one = [&](const Json& value, const std::string& words) {
    const auto faults = of(value);
    ASSERT_EQ(faults.size(), 1u) << value;
    EXPECT_NE(faults[0].find(words), std::string::npos) << faults[0];
  };
  one(shaping({}, {{"target", nullptr}}), "target (is missing");
  one(with(R"({"target": {"surface": "plane"}})"), "search.method = \"shape\"");
  one(with(R"({"search": {"shape_max_mm": 2}})"), "\"plain\"");
  one(shaping({{"maximise", "miscut_margin_mm"}}), "search.method = \"shape\"");
  one(shaping({}, {{"accept", {{"deploys_from_deg", 90}}}}), "target.at_deg = 90");
  one(shaping({}, {{"path", {{"sample_deg", 4}}}, {"accept", {{"deploys_from_deg", 108}}}}),
      "path.sample_deg = 4");
  one(shaping({}, {{"misalignment", {{"vertices", "ring"}}}}), "misalignment.vertices");
  one(shaping({}, {{"misalignment", {{"vertices", "all"}, {"kind", "parallel"}}}}), "parallel");
  one(shaping({}, {{"accept", {{"deploys_from_deg", 105}, {"by", "energy"}}}}), "energy");
  EXPECT_TRUE(of(shaping({}, {{"misalignment", {{"vertices", "interior"}}}})).empty());
}

}  // namespace
}  // namespace misalign::schema
