// campaign.schema.json and read_campaign accept and refuse the same values.
#include "schema/campaign/campaign_file.hpp"
#include "tests/schema/schema_agreement.hpp"

namespace misalign::schema {
namespace {

constexpr Mutation kRefused[] = {
    {"/extra", "1"},
    {"/pattern/extra", "1"},
    {"/misalignment/extra", "1"},
    {"/path/extra", "1"},
    {"/accept/extra", "1"},
    {"/stop/extra", "1"},
    {"/pattern/displacements_mm", "{\"A10\": [0.4, 0.0]}"},
    {"/name", "\"\""},
    {"/name", "\"two words\""},
    {"/name", "\"../up\""},
    {"/name", "\".hidden\""},
    {"/name", "\"-option\""},
    {"/name", "\"line\\n\""},
    {"/pattern/family", "\"waterbomb\""},
    {"/pattern/rows", "2"},
    {"/pattern/rows", "85"},
    {"/pattern/rows", "-6"},
    {"/pattern/rows", "6.5"},
    {"/pattern/rows", "1e30"},
    {"/pattern/columns", "2"},
    {"/pattern/columns", "85"},
    {"/pattern/panel_width_mm", "0"},
    {"/pattern/panel_width_mm", "0.0009"},
    {"/pattern/panel_width_mm", "-80"},
    {"/pattern/panel_width_mm", "1000001"},
    {"/pattern/panel_height_mm", "0.0009"},
    {"/pattern/panel_height_mm", "1000001"},
    {"/pattern/zigzag_offset_mm", "0.0009"},
    {"/pattern/zigzag_offset_mm", "1000001"},
    {"/pattern/holes", "\"checkerboard\""},
    {"/pattern/holes", "[]"},
    {"/pattern/holes", "[7]"},
    {"/pattern/holes", "[[1]]"},
    {"/pattern/holes", "[[1, 2, 3]]"},
    {"/pattern/holes", "[[1, \"2\"]]"},
    {"/pattern/holes", "[[1, 2.5]]"},
    {"/pattern/holes", "[[-1, 2]]"},
    {"/pattern/holes", "[[1, 64]]"},
    {"/pattern/holes", "[[1, 2], [1, 2]]"},
    {"/misalignment/vertices", "\"most\""},
    {"/misalignment/kind", "\"paralel\""},
    {"/misalignment/signs", "\"any\""},
    {"/misalignment/vertices", "[]"},
    {"/misalignment/vertices", "[9]"},
    {"/misalignment/vertices", "[\"9\"]"},
    {"/misalignment/vertices", "[\"A0\"]"},
    {"/misalignment/vertices", "[\"A09\"]"},
    {"/misalignment/vertices", "[\"A9x\"]"},
    {"/misalignment/vertices", "[\"A9\", \"A9\"]"},
    {"/misalignment/amplitude_mm", "0"},
    {"/misalignment/amplitude_mm", "9e-10"},
    {"/misalignment/amplitude_mm", "-0.4"},
    {"/misalignment/amplitude_mm", "1000001"},
    {"/misalignment/levels", "\"binary\""},
    {"/misalignment/grid_mm", "0"},
    {"/path/sample_deg", "0"},
    {"/path/sample_deg", "0.009"},
    {"/path/sample_deg", "60.5"},
    {"/path/end_deg", "0"},
    {"/path/end_deg", "181"},
    {"/accept/deploys_from_deg", "0"},
    {"/accept/deploys_from_deg", "181"},
    {"/accept/between_samples", "\"exakt\""},
    {"/accept/between_samples", "\"true\""},
    {"/accept/between_samples", "1"},
    {"/accept/between_samples", "null"},
    {"/accept", R"({"stops_at_deg": 0, "stop_stiffness_mm2_per_rad2": 5})"},
    {"/accept", R"({"stops_at_deg": 181, "stop_stiffness_mm2_per_rad2": 5})"},
    {"/accept", R"({"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 0})"},
    {"/accept", R"({"stops_at_deg": 60, "stop_stiffness_mm2_per_rad2": 2e9})"},
    {"/accept", R"({"stops_at_deg": "60", "stop_stiffness_mm2_per_rad2": 5})"},
    {"/accept/by", "\"all\""},
    {"/accept/by", "null"},
    {"/accept/fill", "50"},
    {"/accept/fill", R"({"stiffness_n_per_mm": 50})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "foam"}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "none"}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "rest_deg": 60}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "stiffness_n_per_mm": 0}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "on": "one_a_hole"}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "stroke_limit": 0.1}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "plate", "rest_deg": 60}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "shear_mpa": 1}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "plate", "prestretch": 0.09}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "plate", "preload_n": 1}})"},
    {"/accept", R"({"by": "energy", "least_friction_n_mm_per_mm": 0})"},
    {"/accept", R"({"by": "energy", "least_moment_n_mm": 2e9})"},
    {"/search/extra", "1"},
    {"/search/method", "\"annealing\""},
    {"/search/levels_deg", "\"automatic\""},
    {"/search/levels_deg", "[]"},
    {"/search/levels_deg", "[181]"},
    {"/search/levels_deg", "[\"150\"]"},
    {"/search/levels_deg", "[-1]"},
    {"/search/particles", "1"},
    {"/search/particles", "1000001"},
    {"/search/sweeps", "0"},
    {"/search/sweeps", "10001"},
    {"/search/sweeps", "1.5"},
    {"/search/first_draws", "1"},
    {"/search/first_draws", "1000000001"},
    {"/search/maximise", "\"static_friction_n_mm_per_mm\""},
    {"/search/subject_to", "\"stroke_max <= 0.06\""},
    {"/search/subject_to", "[\"stroke_max >= 0.06\"]"},
    {"/search/subject_to", "[\"stroke <= 0.06\"]"},
    {"/search/from_deg", "0"},
    {"/search/from_deg", "181"},
    {"/search/stiffness_n_per_mm", "0"},
    {"/search/preload_n", "-1"},
    {"/search/shifts", "\"binary\""},
    {"/search/grid_mm", "0"},
    {"/search/least_slope_mm_per_deg", "-1"},
    {"/search/most_steps", "0"},
    {"/search/most_steps", "100001"},
    {"/seed", "-1"},
    {"/seed", "1.5"},
    // Not 2^63, the first that is refused: to valijson, which compares in double, it is 2^63 - 1.
    {"/seed", "9223372036854780000"},
    {"/stop/draws", "-1"},
    {"/stop/draws", "0.5"},
    {"/stop/draws", "9223372036854780000"},
    {"/stop/populations", "-1"},
    {"/stop/populations", "922337204"},
    {"/stop/accepted", "-1"},
    {"/stop/accepted", "0.5"},
    {"/stop/accepted", "9223372036854780000"},
    {"/stop/wall_s", "-1"},
    {"/stop/wall_s", "1000000001"},
    {"/actuators/extra", "1"},
    {"/actuators/stiffness_n_per_mm", "0"},
    {"/actuators/stiffness_n_per_mm", "1000000001"},
    {"/actuators/stroke_limit", "0"},
    {"/actuators/stroke_limit", "8"},
    {"/actuators/preload_n", "-1"},
    {"/actuators/largest_force_n", "0"},
    {"/actuators/rest_deg", "60"},
    {"/actuators/diameter_mm", "5"},
    {"/design/extra", "1"},
    {"/design/from_deg", "0"},
    {"/design/from_deg", "181"},
    {"/design/springs/extra", "1"},
    {"/design/springs/stiffness_n_per_mm", "0"},
    {"/design/springs/stiffness_n_per_mm", "1000000001"},
    {"/design/springs/stroke_limit", "0"},
    {"/design/springs/stroke_limit", "8"},
    {"/design/springs/preloads_n", R"({"A9": 1})"},
    {"/design/springs/preloads_n", R"({"A9-A15": -1})"},
    {"/design/springs/rest_deg", "181"},
    {"/design/springs/diameter_mm", "0"},
    {"/design/springs/on", "\"some\""},
    {"/design/springs/single", R"([{"from": "A9", "to": "A15"}])"},
    {"/design/springs/single", R"([{"from": "9", "to": "A15", "stiffness_n_per_mm": 1}])"},
    {"/design/fill", R"({"kind": "none"})"},  // beside springs
    {"/design", R"({"fill": {"kind": "foam"}})"},
    {"/design", R"({"fill": {"kind": "none", "shear_mpa": 1}})"},
    {"/design", R"({"fill": {"kind": "plate", "stiffness_n_per_mm": 50}})"},
    {"/design", R"({"fill": {"kind": "plate", "prestretch": 0.09}})"},
    {"/design", R"({"fill": {"kind": "plate", "cut_outs": [{"hole": [1, 2], "of_flat": [1]}]}})"},
    {"/design", R"({"fill": {"kind": "plate", "cut_outs": [{"hole": [1, 2]}]}})"},
    {"/design/hinges/extra", "1"},
    {"/design/hinges/friction_n_mm_per_mm", "-0.1"},
    {"/design/hinges/stiffness_n_mm_per_mm", "1000000001"},
    {"/design/hinges/kind", "\"glue\""},
    {"/design/hinges/like", "\"glue\""},
    {"/design/hinges/like", "[\"glued textile\"]"},
    {"/design/hinges/name", "7"},
    {"/design/hinges/film", R"({"thickness_mm": 0.05, "e_gpa": 2.5})"},
    {"/design/hinges/film", "{}"},
    {"/design/material", "\"birch\""},
    {"/design/material", R"({"like": "birch"})"},
    {"/design/material", R"({"crease": "glue"})"},
    {"/design/thickness_mm", "0.0009"},
    {"/design/thickness_mm", "101"},
    {"/design/material", R"({"e_gpa": 0})"},
    {"/design/material", R"({"poisson": 0.5})"},
    {"/design/material", R"({"E_gpa": 70})"},
    {"/design/miscut_mm", "-1"},
    {"/design/play_mm", "0"},
    {"/design/hold", "[0]"},
    {"/design/hold", "[0, -1]"},
    {"/design/hold", "[0, 0.5]"},
    {"/design/gravity", "[0, 0]"},
    {"/design/gravity", "[0, 0, 1001]"},
    {"/design/gravity", "[0, 0, \"down\"]"},
};

void expect_refused_by_both(const Json& schema, const Json& value, const std::string& key) {
  EXPECT_NE(complaint(schema, value), "") << "the schema accepts " << value;
  const std::string sentence = refusal(value);
  EXPECT_NE(sentence, "") << "read_campaign accepts " << value;
  EXPECT_NE(sentence.find(key), std::string::npos) << key << " is not named: " << sentence;
}

TEST(CampaignValues, RefusesWhatTheCodeRefuses) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const Mutation& mutation : kRefused) {
    expect_refused_by_both(schema, with(good, mutation.at, Json::parse(mutation.value)),
                           dotted(Pointer(mutation.at)));
  }
  expect_refused_by_both(schema, with(good, "/name", std::string(101, 'x')), "name");
}

// Both say what drives the sheet.
TEST(CampaignValues, RefusesActuatorsBesideAFilling) {
  Json both = without(campaign_json(default_campaign()), Pointer("/design"));
  both["actuators"] = Json::object();
  both["design"] = {{"from_deg", 140}};
  EXPECT_EQ(complaint(campaign_schema(), both), "");
  EXPECT_EQ(refusal(both), "");
  both["design"]["fill"] = {{"kind", "plate"}};
  expect_refused_by_both(campaign_schema(), both, "actuators");
}

TEST(CampaignValues, RefusesEveryWrongType) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  walk(good, [&](const Pointer& at, const Json& value) {
    const std::string key = at.empty() ? "the document" : dotted(at);
    // No key holds an object where it holds none now, or another kind of scalar.
    std::vector<Json> wrong = {Json::array({true})};
    if (!value.is_boolean()) wrong.push_back(true);
    if (!value.is_object()) wrong.push_back(Json::object({{"a", 1}}));
    if (!value.is_string()) wrong.push_back("text");
    if (value.is_string() || value.is_object() || value.is_boolean()) wrong.push_back(7);
    static const std::set<std::string> kNumbersOfDesign = {"design.springs",
                                                           "design.springs.stiffness_n_per_mm",
                                                           "design.hinges",
                                                           "design.hinges.friction_n_mm_per_mm",
                                                           "design.hinges.stiffness_n_mm_per_mm",
                                                           "design.springs.rest_deg",
                                                           "design.springs.pull_only",
                                                           "design.hold_flat",
                                                           "design.springs.on"};
    const bool may_be_null = key.find("stop.") == 0 || key.find("accept.stop") == 0 ||
                             key == "accept.fill" || key.find("accept.least_") == 0 ||
                             key == "misalignment.grid_mm" || key == "search.from_deg" ||
                             key == "search.grid_mm" || key == "target" ||
                             (key.find("design.") == 0 && !kNumbersOfDesign.contains(key));
    if (!may_be_null) wrong.push_back(nullptr);
    for (const Json& other : wrong) {
      expect_refused_by_both(schema, at.empty() ? other : with(good, at.to_string(), other), key);
    }
  });
}

TEST(CampaignValues, RefusesMissingKeys) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const char* at : {"/pattern", "/pattern/family", "/pattern/rows", "/pattern/columns"}) {
    expect_refused_by_both(schema, without(good, Pointer(at)), dotted(Pointer(at)));
  }
}

constexpr Mutation kAccepted[] = {
    {"/name", "\"a\""},
    {"/name", "\"_4x4-run.2\""},
    {"/pattern/rows", "4"},
    {"/pattern/columns", "8"},
    {"/pattern/panel_width_mm", "20"},
    {"/pattern/panel_height_mm", "35.5"},
    {"/pattern/zigzag_offset_mm", "10"},
    {"/pattern/holes", "\"checkerboard-even\""},
    {"/pattern/holes", "[[1,2],[1,4],[2,1],[2,3],[3,2],[3,4],[4,1],[4,3]]"},
    {"/misalignment", "{}"},
    {"/misalignment/vertices", "\"ring\""},
    {"/misalignment/vertices", "\"all\""},
    {"/misalignment/vertices", "[\"A41\", \"A9\"]"},
    {"/misalignment/amplitude_mm", "1e-9"},
    {"/misalignment/amplitude_mm", "1"},
    {"/misalignment/levels", "\"uniform\""},
    {"/path", "{\"sample_deg\": 10}"},
    {"/path/sample_deg", "0.01"},
    {"/path/sample_deg", "0.1"},
    {"/path/end_deg", "175"},
    {"/accept", "{}"},
    {"/accept/deploys_from_deg", "1"},
    {"/accept/deploys_from_deg", "180"},
    {"/accept/between_samples", "true"},
    {"/accept/between_samples", "\"exact\""},
    {"/accept", R"({"stops_at_deg": 170, "stop_stiffness_mm2_per_rad2": 1e-9})"},
    {"/accept", R"({"stops_at_deg": null, "stop_stiffness_mm2_per_rad2": null})"},
    {"/accept", R"({"by": "energy", "fill": null})"},
    {"/accept", R"({"by": "energy", "least_friction_n_mm_per_mm": 1e-9, "fill": {"kind": "springs",
                   "stiffness_n_per_mm": 1e-6, "preload_n": 1e6, "pull_only": true}})"},
    {"/accept", R"({"by": "energy", "least_moment_n_mm": 1e9, "fill": {"kind": "plate",
                   "shear_mpa": 1e-6, "thickness_mm": 1000, "prestretch": 10}})"},
    // Keys of a design's filling may say that springs are equal and relaxed flat.
    {"/accept", R"({"by": "energy", "fill": {"kind": "springs", "rest_deg": 0.0, "on": "all",
                   "preloads_n": null, "single": [], "stroke_limit": null, "largest_force_n": null,
                   "diameter_mm": null}})"},
    {"/accept", R"({"by": "energy", "fill": {"kind": "plate", "rest_deg": 0, "cut_outs": null}})"},
    {"/search", "{}"},
    {"/search", R"({"method": "splitting", "particles": 2, "sweeps": 1, "first_draws": 2})"},
    {"/search", R"({"method": "splitting", "particles": 1000000, "first_draws": 1000000000})"},
    {"/search", R"({"method": "splitting", "sweeps": 10000})"},
    {"/search", R"({"method": "optimise", "from_deg": 170, "grid_mm": 0.4, "most_steps": 1,
                    "subject_to": ["stroke_max <= 1", "largest_force_n<=1e9", " miscut_margin_mm >= 0 "]})"},
    {"/search", R"({"method": "optimise", "maximise": "miscut_margin_mm", "shifts": "ternary",
                    "preload_n": 1e6, "least_slope_mm_per_deg": 0, "stiffness_n_per_mm": 1e-6})"},
    {"/search", R"({"method": "splitting", "levels_deg": [0.001, 150, 169.999, 170]})"},
    {"/stop/populations", "null"},
    {"/stop/populations", "922337203"},
    {"/seed", "0"},
    {"/seed", "9223372036854775807"},
    {"/stop", "{}"},
    {"/stop/draws", "0"},
    {"/stop/draws", "null"},
    {"/stop/draws", "9223372036854775807"},
    {"/stop/accepted", "12"},
    {"/stop/wall_s", "0"},
    {"/stop/wall_s", "1e9"},
    {"/actuators", "{}"},
    {"/actuators/stiffness_n_per_mm", "1e-6"},
    {"/actuators/stroke_limit", "0.08"},
    {"/actuators/stroke_limit", "1"},
    {"/actuators/preload_n", "3"},
    {"/actuators/largest_force_n", "25"},
    {"/certify", "true"},
    {"/design", "{}"},
    {"/design/from_deg", "0.01"},
    {"/design/from_deg", "180"},
    {"/design/springs", "{}"},
    {"/design/springs/stroke_limit", "0.08"},
    {"/design/springs/rest_deg", "60"},
    {"/design/springs/pull_only", "true"},
    {"/design/springs/on", "\"one_a_hole\""},
    {"/design/springs/single",
     R"([{"from": "A9", "to": "A15", "stiffness_n_per_mm": 0, "free_mm": 110}])"},
    {"/design/springs/diameter_mm", "5"},
    {"/design", R"({"fill": {"kind": "none"}})"},
    {"/design", R"({"fill": {"kind": "springs", "preloads_n": {"A9-A15": 2}, "on": "all"}})"},
    {"/design", R"({"fill": {"kind": "plate", "shear_mpa": 0.5, "thickness_mm": 1, "prestretch": 10,
                   "rest_deg": 0, "cut_outs": [{"hole": [1, 2], "of_flat": [0.1, 10]}]}})"},
    {"/design", R"({"fill": {"kind": "plate", "cut_outs": null}})"},
    {"/design/hinges", R"({"friction_n_mm_per_mm": 0.02, "kind": "cut"})"},
    {"/design/hinges/kind", "null"},
    {"/design/hinges", R"({"like": "printed pin hinge", "name": "hinges of mine"})"},
    {"/design/hinges", R"({"like": "polyester film 0.1 mm", "film": {"length_mm": 3}})"},
    {"/design/hinges", R"({"film": {"thickness_mm": 0.05, "e_gpa": 2.5, "length_mm": 1}})"},
    {"/design/hinges", R"({"film": null, "like": null})"},
    {"/design/material", "\"birch plywood\""},
    {"/design/material", R"({"like": "PLA", "e_gpa": 3, "crease": "score"})"},
    {"/design/material", R"({"like": null, "crease": null, "strength_mpa": null})"},
    {"/design/thickness_mm", "100"},
    {"/design/material", R"({"name": "birch", "e_gpa": 12, "density_g_per_cm3": 0.68})"},
    {"/design/material", "{}"},
    {"/design/miscut_mm", "0"},
    {"/design/play_mm", "1e-9"},
    {"/design/hold", "[0, 3]"},
    {"/design/gravity", "[0, 0, -1]"},
    // Ends of ranges that need more than one key changed; the pointer "" is the whole document.
    {"", R"({"pattern": {"family": "miura", "rows": 4, "columns": 4}, "path": {"sample_deg": 60},
             "accept": {"deploys_from_deg": 180}})"},
    {"", R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
             "path": {"sample_deg": 0.01, "end_deg": 0.01}, "accept": {"deploys_from_deg": 0.01}})"},
    {"", R"({"pattern": {"family": "miura", "rows": 4, "columns": 4, "panel_width_mm": 1e6,
             "panel_height_mm": 1e6, "zigzag_offset_mm": 1e6}})"},
    {"", R"({"pattern": {"family": "miura", "rows": 4, "columns": 4, "panel_width_mm": 0.001,
             "panel_height_mm": 0.001, "zigzag_offset_mm": 0.001},
             "misalignment": {"amplitude_mm": 1e-9}})"},
};

TEST(CampaignValues, AcceptsWhatTheCodeAccepts) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const Mutation& mutation : kAccepted) {
    const Json value = with(good, mutation.at, Json::parse(mutation.value));
    EXPECT_EQ(complaint(schema, value), "") << value;
    EXPECT_EQ(refusal(value), "") << value;
  }
}

}  // namespace
}  // namespace misalign::schema
