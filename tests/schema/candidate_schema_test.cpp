// candidate.schema.json describes what `misalign export` writes.
#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/certificate_row.hpp"
#include "schema/catalogue/yield.hpp"
#include "schema/exchange/actuators_json.hpp"
#include "schema/exchange/deploy_json.hpp"
#include "schema/pattern/judging_fill.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/certificate/certifier.hpp"
#include "tests/schema/schema_agreement.hpp"

namespace misalign::schema {
namespace {

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
    const solver::Model model(base, campaign.path());
    solver::SheetSolver solver(model);
    const solver::Sheet sheet(solver, shifts_mm);
    const FoldingView view(campaign.pattern, sheet);
    const auto released = *solver::deploy(sheet);
    const solver::Actuators wires{solver::Springs{50},
                                  0.03};  // which some diagonals of Table 1 exceed
    Json exported = folded_pattern_json(campaign.sampling(), view,
                                        actuation_json(view, solver::actuate(sheet, wires)),
                                        exported_deployment_json(released));
    const solver::Certificate certificate =
        solver::Certifier(model).certify(sheet.vertices_mm(), 5);
    exported["certificate"] = certificate_json(
        certificate_row(campaign.pattern, sheet.mechanism(), 7, shifts_mm, certificate, 0.03125));
    exported.update(
        origin_json(campaign, 7, yields_json({{7, 0.05, 100, 90, 2}, {7, 0.1, 1, 0, 1}})));
    return exported;
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
  read_pattern(candidate["pattern"], "", Displacements::allowed, {}, faults);
  EXPECT_TRUE(faults.none());
}

TEST(CandidateSchema, KnowsEveryFilling) {
  EXPECT_EQ(table1_candidate()["actuation"]["fill"]["kind"], "springs");
  const solver::PerforatedSheet base = default_campaign().pattern.base;
  const solver::Diagonal diagonal = solver::build_mechanism(base).diagonals.front();
  solver::Springs springs;
  springs.single = {{{diagonal.from, diagonal.to}, 0, {}}};
  springs.preload.others = {{{diagonal.from, diagonal.to}, 2}};
  solver::RubberPlates plates;
  plates.cut_outs = {{0, {0.9, 0.8}}};
  for (const solver::Fill& fill :
       {solver::Fill(springs), solver::Fill(plates), solver::Fill(solver::NoFill{})}) {
    Json candidate = table1_candidate();
    add_filling(fill, base, candidate["actuation"]);
    EXPECT_EQ(complaint(candidate_schema(), candidate), "");
    EXPECT_NE(complaint(candidate_schema(), with(candidate, "/actuation/fill/kind", "foam")), "");
  }
  for (const solver::Fill& fill :
       {solver::Fill(solver::Springs{}), solver::Fill(solver::RubberPlates{})}) {
    Json candidate = table1_candidate();
    candidate["sampling"].update(judging_fill_json(fill));
    EXPECT_EQ(complaint(candidate_schema(), candidate), "");
    EXPECT_NE(complaint(candidate_schema(), with(candidate, "/sampling/fill/rest_deg", 60)), "");
  }
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
    // Elements of arrays, shifts by label and, when nothing is shifted, their object may be absent;
    // and what nobody has proven, by which criterion it was and the filling in older files, and the
    // rate where the filling is no springs.
    const bool optional =
        at.empty() || at.to_string() == "/certificate" || at.to_string() == "/certificate/by" ||
        at.to_string() == "/actuation/fill" || at.back() == "stiffness_n_per_mm" ||
        at.to_string().find("/displacements_mm") != std::string::npos;
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
      {"/yields", "null"},
      {"/yields/0/trials", "0"},
      {"/yields/0/survivors", "-1"},
      {"/yields/0/share", "1.5"},
      {"/yields/0/amplitude_mm", "-0.1"},
      {"/certificate", "null"},
      {"/certificate/certified_deg", "181"},
      {"/certificate/end", "\"end\""},
      {"/certificate/where", "\"[1,2]\""},
      {"/certificate/hash", "\"0123456789ABCDEF0123456789ABCDEF\""},
      {"/certificate/proof", "\"*\""},
      {"/certificate/intervals", "1.5"},
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
  for (const char* at : {"/verdict/fault_deg", "/verdict/where", "/metrics/slope_min_mm_per_deg",
                         "/certificate/where"}) {
    EXPECT_EQ(complaint(schema, with(candidate, at, nullptr)), "") << at;
  }
  for (const char* place : {"A1-A20", "[0,1] and [12,3]"}) {
    EXPECT_EQ(complaint(schema, with(candidate, "/certificate/where", place)), "") << place;
  }
  EXPECT_EQ(complaint(schema, without(candidate, Pointer("/certificate"))), "");
  EXPECT_EQ(complaint(schema, without(candidate, Pointer("/pattern/displacements_mm"))), "");
}

// A pattern file that was exported: nobody drew it, and it may deploy from nothing.
TEST(CandidateSchema, TakesAPatternThatNobodyDrew) {
  const Json schema = candidate_schema();
  Json pattern = table1_candidate();
  pattern.erase("campaign");
  EXPECT_NE(complaint(schema, pattern), "") << "a draw of no campaign";
  for (const char* key : {"draw", "yields"}) pattern.erase(key);
  EXPECT_EQ(complaint(schema, pattern), "");
  pattern["metrics"] = nullptr;
  pattern["verdict"]["deploys_from_deg"] = 0;
  pattern["verdict"]["first_fault"] = "inactive_diagonal";
  for (Json& diagonal : pattern["diagonals"]) diagonal["elongation"] = nullptr;
  EXPECT_EQ(complaint(schema, pattern), "");
  pattern["verdict"]["first_fault"] = "undecided";
  pattern["verdict"]["cause"] = "stalled";
  EXPECT_EQ(complaint(schema, pattern), "");
  for (const char* key : {"campaign", "draw", "yields"}) pattern[key] = table1_candidate()[key];
  EXPECT_NE(complaint(schema, pattern), "") << "a candidate that deploys from nothing";
}

TEST(CandidateSchema, PatternHasTheRangesOfTheCampaign) {
  const auto candidate = properties_of(candidate_schema());
  for (const auto& [at, property] : properties_of(campaign_schema()["properties"]["pattern"])) {
    // Resolved into the mesh.
    if (at == "/file" || at == "/mm_per_unit" || at.starts_with("/target_")) continue;
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
    // An export always has this one; rows of older catalogues do not.
    const bool may_be_null = nullable.contains(key) && key != "energy_deploys_from_deg";
    EXPECT_EQ(properties.at(key).at("type").is_array(), may_be_null) << key;
    rest.erase(key);
  }
  // Everything else a candidate's row holds is no metric.
  EXPECT_EQ(rest, (std::set<std::string>{"draw", "unit", "displacements_mm", "elongation"}));
}

}  // namespace
}  // namespace misalign::schema
