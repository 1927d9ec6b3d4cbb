// The schema files say what the code does: the same keys, defaults, ranges and refusals. The judge
// of a schema is valijson, which shares nothing with read_campaign.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "schema/carried_files.hpp"
#include "schema/database.hpp"
#include "schema/folding_json.hpp"

namespace misalign::schema {
namespace {

using Pointer = Json::json_pointer;

Json source_json(const std::string& path) {
  return read_json_file(std::string(MISALIGN_SOURCE_DIR) + "/" + path);
}

Json campaign_schema() { return source_json("schema/campaign.schema.json"); }
Json candidate_schema() { return source_json("schema/candidate.schema.json"); }

/// What valijson says of `value`: empty if it is valid.
std::string complaint(const Json& schema_json, const Json& value) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(value), &results)) {
    return "";
  }
  std::string text = "invalid";
  for (const auto& error : results) text += "; " + error.description;
  return text;
}

/// What read_campaign says: empty if it accepts.
std::string refusal(const Json& value) {
  try {
    read_campaign(value, "mutation");
    return "";
  } catch (const UserError& error) {
    EXPECT_EQ(error.exit_code(), kExitBadInput) << value;
    return error.what();
  }
}

/// Calls `see(pointer, value)` for every value in a document, parents first.
void walk(const Json& value, const std::function<void(const Pointer&, const Json&)>& see,
          const Pointer& at = Pointer()) {
  see(at, value);
  if (value.is_object()) {
    for (const auto& [key, child] : value.items()) walk(child, see, at / key);
  } else if (value.is_array()) {
    for (std::size_t k = 0; k < value.size(); ++k) walk(value[k], see, at / k);
  }
}

/// "/pattern/rows" -> "pattern.rows", the name that a sentence gives the key.
std::string dotted(const Pointer& at) {
  std::string name = at.to_string().substr(at.empty() ? 0 : 1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

/// Pointers of all keys: in a document, and in a schema's nested "properties".
std::set<std::string> keys_of(const Json& document) {
  std::set<std::string> keys;
  walk(document, [&](const Pointer& at, const Json&) {
    if (!at.empty()) keys.insert(at.to_string());
  });
  return keys;
}

void collect_properties(const Json& schema, const Pointer& at,
                        std::map<std::string, Json>& properties) {
  if (!schema.contains("properties")) return;
  for (const auto& [key, child] : schema["properties"].items()) {
    properties[(at / key).to_string()] = child;
    collect_properties(child, at / key, properties);
  }
}

std::map<std::string, Json> properties_of(const Json& schema) {
  std::map<std::string, Json> properties;
  collect_properties(schema, Pointer(), properties);
  return properties;
}

Json with(Json document, const std::string& at, Json value) {
  document[Pointer(at)] = std::move(value);
  return document;
}

Json without(Json document, const Pointer& at) {
  document[at.parent_pointer()].erase(at.back());
  return document;
}

TEST(SchemaFiles, DescribeEveryKeyAndRefuseEveryOther) {
  for (const Json& schema : {campaign_schema(), candidate_schema()}) {
    walk(schema, [](const Pointer& at, const Json& part) {
      if (!part.is_object()) return;
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
  for (const auto& [at, property] : properties) {
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
    if (!property.contains("default")) continue;
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

struct Mutation {
  const char* at;     // where the default campaign is changed
  const char* value;  // to what, as JSON
};

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
    {"/pattern/rows", "65"},
    {"/pattern/rows", "-6"},
    {"/pattern/rows", "6.5"},
    {"/pattern/rows", "1e30"},
    {"/pattern/columns", "2"},
    {"/pattern/columns", "65"},
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
    {"/misalignment/vertices", "\"all\""},
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
    {"/path/sample_deg", "0"},
    {"/path/sample_deg", "0.009"},
    {"/path/sample_deg", "60.5"},
    {"/path/end_deg", "0"},
    {"/path/end_deg", "181"},
    {"/accept/deploys_from_deg", "0"},
    {"/accept/deploys_from_deg", "181"},
    {"/seed", "-1"},
    {"/seed", "1.5"},
    // Not 2^63, the first that is refused: to valijson, which compares in double, it is 2^63 - 1.
    {"/seed", "9223372036854780000"},
    {"/stop/draws", "-1"},
    {"/stop/draws", "0.5"},
    {"/stop/draws", "9223372036854780000"},
    {"/stop/accepted", "-1"},
    {"/stop/accepted", "0.5"},
    {"/stop/accepted", "9223372036854780000"},
    {"/stop/wall_s", "-1"},
    {"/stop/wall_s", "1000000001"},
};

void expect_refused_by_both(const Json& schema, const Json& value, const std::string& key) {
  EXPECT_NE(complaint(schema, value), "") << "the schema accepts " << value;
  const std::string sentence = refusal(value);
  EXPECT_NE(sentence, "") << "read_campaign accepts " << value;
  EXPECT_NE(sentence.find(key), std::string::npos) << key << " is not named: " << sentence;
}

TEST(CampaignSchema, RefusesWhatTheCodeRefuses) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const Mutation& mutation : kRefused) {
    expect_refused_by_both(schema, with(good, mutation.at, Json::parse(mutation.value)),
                           dotted(Pointer(mutation.at)));
  }
  expect_refused_by_both(schema, with(good, "/name", std::string(101, 'x')), "name");
}

TEST(CampaignSchema, RefusesEveryWrongType) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  walk(good, [&](const Pointer& at, const Json& value) {
    const std::string key = at.empty() ? "the document" : dotted(at);
    // No key holds a boolean, an object where it holds none now, or the other kind of scalar.
    std::vector<Json> wrong = {true, Json::array({true})};
    if (!value.is_object()) wrong.push_back(Json::object({{"a", 1}}));
    if (!value.is_string()) wrong.push_back("text");
    if (value.is_string() || value.is_object()) wrong.push_back(7);
    if (key.find("stop.") != 0) wrong.push_back(nullptr);
    for (const Json& other : wrong) {
      expect_refused_by_both(schema, at.empty() ? other : with(good, at.to_string(), other), key);
    }
  });
}

TEST(CampaignSchema, RefusesMissingKeys) {
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
    {"/seed", "0"},
    {"/seed", "9223372036854775807"},
    {"/stop", "{}"},
    {"/stop/draws", "0"},
    {"/stop/draws", "null"},
    {"/stop/draws", "9223372036854775807"},
    {"/stop/accepted", "12"},
    {"/stop/wall_s", "0"},
    {"/stop/wall_s", "1e9"},
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

TEST(CampaignSchema, AcceptsWhatTheCodeAccepts) {
  const Json schema = campaign_schema(), good = campaign_json(default_campaign());
  for (const Mutation& mutation : kAccepted) {
    const Json value = with(good, mutation.at, Json::parse(mutation.value));
    EXPECT_EQ(complaint(schema, value), "") << value;
    EXPECT_EQ(refusal(value), "") << value;
  }
}

/// The candidate that Table 1 would be, as `misalign export` writes it.
Json table1_candidate() {
  static const Json candidate = [] {
    const Campaign campaign = default_campaign();
    const solver::PerforatedSheet& base = campaign.pattern.base;
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count());
    const Json golden = source_json("tests/golden/table1_odd.json");
    for (const auto& [label, shift] : golden.at("displacements_mm").items()) {
      shifts_mm.col(vertex_of_label(label, base.sheet.vertex_count())) << shift[0].get<double>(),
          shift[1].get<double>();
    }
    const auto mechanism = solver::build_mechanism(base.sheet, base.holes, base.folding);
    const auto plan =
        solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, campaign.path());
    const solver::FlatVertices vertices_mm = base.sheet.vertices_mm + shifts_mm;
    const auto history = solver::record_history(base, mechanism, plan, vertices_mm);
    const auto metrics = solver::measure(base, vertices_mm, history, campaign.sample_deg);
    const FoldingView view{campaign.pattern, shifts_mm, mechanism, history, campaign.sample_deg};
    return candidate_json(campaign, 7, view, metrics);
  }();
  return candidate;
}

TEST(CandidateSchema, AcceptsARealCandidate) {
  const Json candidate = table1_candidate();
  EXPECT_EQ(complaint(candidate_schema(), candidate), "");
  const Json golden = source_json("tests/golden/table1_odd.json");
  EXPECT_EQ(candidate["metrics"]["deploys_from_deg"], golden["deploys_from_deg"]);
  EXPECT_EQ(candidate["verdict"]["first_fault"], golden["first_fault"]);
  EXPECT_EQ(candidate["diagonals"].size(), golden["diagonals"].size());
  EXPECT_EQ(candidate["metrics"]["shifted_vertices"], golden["displacements_mm"].size());
  // What is exported can be folded again.
  InputFaults faults;
  read_pattern(candidate["pattern"], "", Displacements::allowed, faults);
  EXPECT_TRUE(faults.none());
}

TEST(CandidateSchema, NeedsEveryKeyAndRefusesEveryOther) {
  const Json candidate = table1_candidate(), schema = candidate_schema();
  int removed = 0;
  walk(candidate, [&](const Pointer& at, const Json& value) {
    if (value.is_object()) {
      EXPECT_NE(complaint(schema, with(candidate, at.to_string() + "/extra", 1)), "") << at;
      const std::string nowhere = at.to_string() + "/extra";
      EXPECT_NE(complaint(schema, with(candidate, nowhere, nullptr)), "") << at;
    }
    // Elements of arrays, shifts by label and, when nothing is shifted, their object may be absent.
    const bool optional =
        at.empty() || at.to_string().find("/displacements_mm") != std::string::npos;
    if (optional || candidate[at.parent_pointer()].is_array()) return;
    EXPECT_NE(complaint(schema, without(candidate, at)), "") << at;
    ++removed;
  });
  EXPECT_GT(removed, 40);
}

TEST(CandidateSchema, RefusesWrongValues) {
  const Json candidate = table1_candidate(), schema = candidate_schema();
  constexpr Mutation kWrong[] = {
      {"/draw", "-1"},
      {"/draw", "1.5"},
      {"/campaign/identity", "\"0123\""},
      {"/campaign/identity", "\"0123456789ABCDEF0123456789ABCDEF\""},
      {"/verdict/first_fault", "\"undecided\""},
      {"/verdict/first_fault", "\"inactive_diagonal\""},
      {"/verdict/where", "\"somewhere\""},
      {"/verdict/fault_deg", "0"},
      {"/metrics/deploys_from_sample", "0"},
      {"/metrics/deploys_from_sample", "null"},
      {"/metrics/elongation_min", "0.1"},
      {"/metrics/elongation_max", "-0.1"},
      {"/metrics/singular_value_min", "null"},
      {"/metrics/increasing", "0.5"},
      {"/diagonals", "[]"},
      {"/diagonals/0/hole", "[1]"},
      {"/diagonals/0/from", "\"17\""},
      {"/diagonals/0/flat_mm", "0"},
      {"/pattern/displacements_mm", "{}"},
      {"/pattern/displacements_mm/A10", "[0.4]"},
      {"/pattern/displacements_mm/A10", "[0.4, \"0\"]"},
      {"/pattern/displacements_mm/B10", "[0.4, 0.4]"},
  };
  for (const Mutation& m : kWrong) {
    EXPECT_NE(complaint(schema, with(candidate, m.at, Json::parse(m.value))), "")
        << m.at << " = " << m.value;
  }
  // Null is a value for what there may be none of, and an unshifted sheet has no displacements.
  for (const char* at : {"/verdict/fault_deg", "/verdict/where", "/metrics/slope_min_mm_per_deg"}) {
    EXPECT_EQ(complaint(schema, with(candidate, at, nullptr)), "") << at;
  }
  EXPECT_EQ(complaint(schema, without(candidate, Pointer("/pattern/displacements_mm"))), "");
}

TEST(CandidateSchema, PatternHasTheRangesOfTheCampaign) {
  const auto candidate = properties_of(candidate_schema());
  for (const auto& [at, property] : properties_of(campaign_schema()["properties"]["pattern"])) {
    for (const char* word : {"type", "minimum", "maximum", "enum", "anyOf"}) {
      EXPECT_EQ(candidate.at("/pattern" + at).value(word, Json()), property.value(word, Json()))
          << at << " " << word;
    }
  }
}

TEST(CandidateSchema, MetricsAreTheColumnsOfTheCatalogue) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  for (const CarriedFile& file : carried_files()) {
    if (file.path == "schema/catalogue.sql") database.exec(file.text);
  }
  std::set<std::string> columns, nullable;
  SQLite::Statement info(database,
                         "SELECT name, \"notnull\", pk FROM pragma_table_info('candidate')");
  while (info.executeStep()) {
    const std::string name = info.getColumn(0).getString();
    columns.insert(name);
    if (info.getColumn(1).getInt() == 0 && info.getColumn(2).getInt() == 0) nullable.insert(name);
  }
  const Json metrics = table1_candidate()["metrics"];
  const Json properties = candidate_schema()["properties"]["metrics"]["properties"];
  std::set<std::string> rest = columns;
  for (const auto& [key, value] : metrics.items()) {
    EXPECT_TRUE(columns.contains(key)) << key;
    EXPECT_EQ(properties.at(key).at("type").is_array(), nullable.contains(key)) << key;
    rest.erase(key);
  }
  // Everything else a candidate's row holds is no metric.
  EXPECT_EQ(rest, (std::set<std::string>{"draw", "unit", "displacements_mm", "elongation"}));
}

}  // namespace
}  // namespace misalign::schema
