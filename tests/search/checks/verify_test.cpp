// Alterations of a catalogue with all its sums mended are found by computing it again.
#include <gtest/gtest.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue.hpp"
#include "schema/catalogue/digest.hpp"
#include "search/checks/verification_text.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/sheets/study_functions.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

using schema::Json;

class VerifyTest : public testing::Test {
 protected:
  static constexpr std::uint64_t kUnits = 6, kUnitDraws = 12;

  // Short paths, of which about half deploy.
  static schema::Campaign campaign() {
    return schema::read_campaign(
        Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
                        "path": {"end_deg": 60}, "accept": {"deploys_from_deg": 58}})"),
        "test");
  }
  void SetUp() override {
    folder_.clear();  // tests begin again, too
    static const std::vector<schema::UnitRecord> units = all_units();
    const DrawEvaluator evaluator(campaign());
    schema::Catalogue catalogue(path_(), evaluator.campaign(), evaluator.mechanism());
    catalogue.begin_run({"host", "0", "none", "g++", "-O2", "golden", 1},
                        {{0, kUnits * kUnitDraws}, {}, {}});
    for (const schema::UnitRecord& unit : units) catalogue.commit({unit});
    catalogue.end_run("complete");
  }
  static std::vector<schema::UnitRecord> all_units() {
    DrawEvaluator evaluator(campaign());
    std::vector<schema::UnitRecord> units;
    for (std::uint64_t k = 0; k < kUnits; ++k) {
      units.push_back(work_off(evaluator, {k * kUnitDraws, (k + 1) * kUnitDraws}));
    }
    return units;
  }

  std::string path_() const { return folder_.file("a.db"); }
  void change(const std::string& sql) {
    SQLite::Database(path_(), SQLite::OPEN_READWRITE).exec(sql);
  }
  Verification look(const VerifyOptions& options) {
    const auto database = schema::open_for_reading(path_());
    return verify(*database, path_(), options);
  }
  std::string first_column(const VerifyOptions& options) {
    const Verification v = look(options);
    return v.good() ? "" : v.findings.front().details.value("column", v.findings.front().sentence);
  }
  std::int64_t number(const std::string& sql) {
    return SQLite::Database(path_()).execAndGet(sql).getInt64();
  }
  // The unit's row, and what was screened, as its candidates are now: all that can be mended
  // without computing.
  void mend(std::int64_t unit) {
    SQLite::Database database(path_(), SQLite::OPEN_READWRITE);
    schema::CandidateSum sum;
    int accepted = 0;
    SQLite::Statement row(database,
                          "SELECT draw, deploys_from_sample FROM candidate WHERE unit = ?");
    row.bind(1, unit);
    while (row.executeStep()) {
      sum.add(schema::draw_of(row.getColumn(0)), row.getColumn(1).getInt());
      ++accepted;
    }
    SQLite::Statement update(database,
                             "UPDATE unit SET accepted = ?1, rejected = hi - lo - undecided - ?1, "
                             "digest_part = ?2 WHERE lo = ?3");
    const auto bytes = sum.bytes();
    update.bind(1, accepted);
    update.bind(2, bytes.data(), static_cast<int>(bytes.size()));
    update.bind(3, unit);
    update.exec();
    database.exec(
        "UPDATE screened SET draws = draws + (SELECT sum(rejected) FROM unit) - (SELECT sum(draws) "
        "FROM screened) WHERE (cause, tested_deg) = (SELECT cause, tested_deg FROM screened ORDER "
        "BY draws DESC LIMIT 1)");
  }

  const Folder folder_{"verify"};
};

TEST_F(VerifyTest, AGoodOneIsGoodThroughoutSlow) {
  const Verification v = look({.sample = {}, .units = kUnits});
  for (const auto& finding : v.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_GT(v.checked.size(), 10u);
  EXPECT_EQ(v.fault_samples.checked, v.fault_samples.of);
  EXPECT_GT(v.fault_samples.of, 0u);
  EXPECT_EQ(v.units.checked, kUnits);
  EXPECT_EQ(v.draws_again, kUnits * kUnitDraws);
  EXPECT_EQ(v.chance_to_find_one(), 1);
  EXPECT_EQ(look({.units = 3}).chance_to_find_one(), 0.5);
  EXPECT_EQ(look({.units = 100}).units.checked, kUnits);
}

TEST_F(VerifyTest, AlteredFaultSamplesAreFound) {
  const std::pair<const char*, const char*> kChanges[] = {
      {"fault_deg", "UPDATE fault_sample SET fault_deg = coalesce(fault_deg, 3) + 1"},
      {"where", "UPDATE fault_sample SET \"where\" = 'A1-A2'"},
      {"first_fault", "UPDATE fault_sample SET first_fault = 'over_folded'"},
  };
  for (const auto& [column, sql] : kChanges) {
    TearDown();
    SetUp();
    change(sql);
    EXPECT_EQ(first_column({.sample = 1}), "fault_sample." + std::string(column));
    EXPECT_EQ(first_column({.sample = 0, .units = kUnits}), "fault_sample." + std::string(column));
  }
}

// Up to version 1.0.0 one name stood for both faults between samples: either is no finding where
// the other is stored.
TEST_F(VerifyTest, EitherFaultBetweenSamplesMayHaveBeenStored) {
  Json exact = Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4},
                               "accept": {"deploys_from_deg": 150, "between_samples": "exact"}})");
  solver::Verdict verdict;
  for (std::uint64_t seed = 1; verdict.first_fault != solver::Fault::reverses_between; ++seed) {
    ASSERT_LT(seed, 100u);
    exact["seed"] = seed;
    verdict = DrawEvaluator(schema::read_campaign(exact, "test")).judge({0, 1}).front();
  }
  std::filesystem::remove(path_());
  DrawEvaluator evaluator(schema::read_campaign(exact, "test"));
  {
    schema::Catalogue catalogue(path_(), evaluator.campaign(), evaluator.mechanism());
    catalogue.begin_run({"host", "0", "none", "g++", "-O2", "golden", 1}, {{0, 1}, {}, {}});
    catalogue.commit({work_off(evaluator, {0, 1})});
    catalogue.end_run("complete");
  }
  const VerifyOptions kAll{.sample = {}, .units = 1};
  for (const auto& [name, is_good] :
       {std::pair("reverses_between_samples", true), std::pair("bump_between_samples", true),
        std::pair("not_monotone", false)}) {
    change(std::string("UPDATE fault_sample SET first_fault = '") + name + "'");
    EXPECT_EQ(look(kAll).good(), is_good) << name;
  }
  const ColumnTolerances exported{80, 1};
  EXPECT_TRUE(exported.agree("first_fault", "bump_between_samples", "reverses_between_samples"));
  EXPECT_FALSE(exported.agree("first_fault", "bump_between_samples", "not_monotone"));
}

TEST_F(VerifyTest, AFalsifiedRememberedNumberIsFound) {
  {
    const auto database = schema::open_for_reading(path_());
    add_study_functions(*database, path_());
    SQLite::Statement rows(*database,
                           "SELECT energy_n_mm(draw), bent_energy_n_mm(draw, 50) "
                           "FROM candidate ORDER BY draw LIMIT 3");
    while (rows.executeStep()) {
    }
  }
  const VerifyOptions kAll{.sample = {}};
  EXPECT_TRUE(look(kAll).good());
  EXPECT_EQ(look(kAll).memory.checked, 6);
  EXPECT_EQ(look({.sample = 2}).memory.checked, 2);
  SQLite::Database memory(schema::StudyMemory::path_beside(path_()), SQLite::OPEN_READWRITE);
  for (const char* const altered : {"value * 1.00001", "NULL"}) {
    memory.exec(std::string("CREATE TEMP TABLE IF NOT EXISTS good AS SELECT * FROM number; ") +
                "UPDATE number SET value = " + altered + " WHERE from_deg = 50");
    const Verification v = look(kAll);
    EXPECT_EQ(v.findings.size(), 3);
    EXPECT_EQ(first_column(kAll), "bent_energy_n_mm");
    memory.exec("REPLACE INTO number SELECT * FROM good");
  }
  EXPECT_TRUE(look(kAll).good());
  memory.exec("UPDATE number SET version = 0");
  EXPECT_EQ(look(kAll).memory.stale, 6);
  EXPECT_EQ(look(kAll).memory.current, 0);
}

TEST_F(VerifyTest, ARemovedCandidateWithItsSumsIsFoundByMakingUnitsAgainSlow) {
  const std::int64_t draw = number("SELECT max(draw) FROM candidate WHERE draw % 1024 > 30");
  const std::int64_t unit =
      number("SELECT unit FROM candidate WHERE draw = " + std::to_string(draw));
  change("DELETE FROM candidate WHERE draw = " + std::to_string(draw));
  mend(unit);
  EXPECT_TRUE(look({.sample = {}}).good());  // nothing else can know
  const Verification v = look({.sample = 0, .units = kUnits});
  ASSERT_EQ(v.findings.size(), 1u);
  EXPECT_EQ(v.findings[0].details.at("where"), "draw " + std::to_string(draw));
  EXPECT_EQ(v.findings[0].details.at("column"), "verdict");
  // As often as is said: 60 choices of 2 units of 6.
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Verification some = look({.sample = 0, .units = 2, .seed = seed});
    EXPECT_EQ(some.units.checked, 2u);
    found += !some.good();
  }
  EXPECT_NEAR(found, 20, 11);  // three standard deviations of a binomial
}

// Somebody else may have known no answer: no finding, but counted and said.
TEST_F(VerifyTest, ACandidateMadeUndecidedIsSaid) {
  const std::string draw = std::to_string(number("SELECT max(draw) FROM candidate"));
  const std::int64_t unit = number("SELECT unit FROM candidate WHERE draw = " + draw);
  const std::string at = std::to_string(unit);
  change("DELETE FROM candidate WHERE draw = " + draw + "; INSERT INTO undecided VALUES (" + draw +
         ", " + at + ", 'stalled', 1); UPDATE unit SET undecided = 1, accepted = accepted - 1 " +
         "WHERE lo = " + at);
  mend(unit);
  const Verification v = look({.sample = 0, .units = kUnits});
  for (const auto& finding : v.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_EQ(v.decided_now, 1u);
  EXPECT_NE(verification_text(v).find("not compared 1 draw of them: undecided"), std::string::npos);
}

TEST_F(VerifyTest, AnInventedCandidateIsFoundByMakingUnitsAgain) {
  const std::string draw = std::to_string(number(
      "WITH RECURSIVE d(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM d WHERE x < 71) SELECT min(x) "
      "FROM d WHERE x NOT IN (SELECT draw FROM candidate)"));
  change("CREATE TEMP TABLE t AS SELECT * FROM candidate LIMIT 1; UPDATE t SET draw = " + draw +
         ", unit = " + draw + " - " + draw + " % 12; INSERT INTO candidate SELECT * FROM t");
  mend(std::stoll(draw) - std::stoll(draw) % 12);
  const Verification v = look({.sample = 0, .units = kUnits});
  ASSERT_EQ(v.findings.size(), 1u);
  EXPECT_EQ(v.findings[0].details.at("where"), "draw " + draw);
}

}  // namespace
}  // namespace misalign::search
