// Damaged catalogues: a sentence for whoever reads one or goes on writing it, and nothing worse.
#include <algorithm>

#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/survival.hpp"
#include "schema/report/report.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

class DamageTest : public CatalogueTest {
 protected:
  // With these statements done to it, past keys and checks.
  std::string damage(const std::string& sql) const {
    std::filesystem::remove(path());
    {
      Catalogue catalogue = open();
      catalogue.begin_run(kRun, {{0, 4000}, {}, {}});
      for (const std::uint64_t lo : {0, 2000}) catalogue.commit({unit(lo, lo + 2000)});
      catalogue.end_run("complete");
    }
    change_rows(path(), sql);
    return path();
  }
  /// Refused as a bad file, in a sentence that names it and has this word.
  void expect_bad_file(const Refusal& refused, const std::string& word, const std::string& sql) {
    EXPECT_EQ(refused.cause, Cause::bad_input) << sql << ": " << refused.sentence;
    EXPECT_EQ(refused.sentence.find(path()), 0u) << sql << ": " << refused.sentence;
    EXPECT_NE(refused.sentence.find(word), std::string::npos) << sql << ": " << refused.sentence;
  }
};

TEST_F(DamageTest, StateIsRefused) {
  const std::pair<const char*, const char*> kDamages[] = {
      {"UPDATE unit SET rejected = rejected + 1 WHERE lo = 2000", "unit 2000 does not add up"},
      {"UPDATE unit SET accepted = -1, rejected = rejected + accepted + 1", "does not add up"},
      {"UPDATE unit SET undecided = 1 << 62, rejected = -(1 << 62)", "does not add up"},
      {"UPDATE unit SET digest_part = x'00' WHERE lo = 2000", "unit 2000 does not add up"},
      {"UPDATE unit SET lo = 1999 WHERE lo = 2000", "unit 1999 is no range"},
      {"UPDATE unit SET lo = -5, hi = -2 WHERE lo = 0", "unit -5 is no range"},
      {"UPDATE unit SET hi = 1 WHERE lo = 2000", "unit 2000 is no range"},
      {"UPDATE campaign SET goal_end = -1", "goal"},
      {"UPDATE campaign SET range_hi = 0, goal_end = 0", "goal"},
      {"UPDATE campaign SET goal_relative_error = -1", "goal"},
      {"DELETE FROM campaign", "no campaign"},
      {"DROP TABLE fault_sample", "fault_sample"},
      {"ALTER TABLE unit RENAME COLUMN seconds TO minutes", "seconds"},
  };
  for (const auto& [sql, word] : kDamages) {
    damage(sql);
    expect_bad_file(refusal([&] { read_state(*open_for_reading(path())); }), word, sql);
  }
  // A part of a unit counts by its rows, which may say more than it.
  const std::string sql =
      "UPDATE campaign SET goal_end = 6; WITH RECURSIVE n (draw) AS (VALUES (0) UNION ALL SELECT "
      "draw + 1 FROM n WHERE draw < 5) INSERT OR REPLACE INTO undecided SELECT draw, 0, 'stalled', "
      "1 FROM n";
  const auto database = open_for_reading(damage(sql));
  expect_bad_file(refusal([&] { read_state(*database); }), "accepted and undecided", sql);
}

// SQLite looks at no CHECK while it reads; a share of negative draws is none.
TEST_F(DamageTest, WeightsThatNoRowHasAreRefused) {
  for (const char* weight : {"-1000", "0", "1023"}) {
    const std::string sql = "UPDATE fault_sample SET stands_for = " + std::string(weight);
    const auto database = open_for_reading(damage(sql));
    expect_bad_file(refusal([&] { read_state(*database); }), weight, sql);
    expect_bad_file(refusal([&] { read_survival(*database); }), weight, sql);
    const auto findings = check_ledger(*database, campaign_);
    ASSERT_FALSE(findings.empty()) << sql;
    EXPECT_NE(findings.front().sentence.find("stands_for"), std::string::npos)
        << findings.front().sentence;
  }
}

// A million brackets would exhaust the stack of whoever copies them.
TEST_F(DamageTest, DiagonalsAreNotFollowedInDepth) {
  const std::string others(2 * (mechanism_.diagonals.size() - 1), '0');  // ,0,0,0
  for (const std::string& rest :
       {std::string(), " || replace(hex(zeroblob(500000)), '0', ']') || replace('" + others +
                           "', '00', ',0') || ']'"}) {
    damage("UPDATE campaign SET diagonals = '[' || replace(hex(zeroblob(500000)), '0', '[')" +
           rest);
    const auto findings = check_ledger(*open_for_reading(path()), campaign_);
    EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& finding) {
      return finding.details.at("column") == "diagonals";
    }));
  }
}

TEST_F(DamageTest, ConfigurationsAreRefused) {
  for (const char* configuration :
       {"'nonsense'", "''", "'{}'", "'[1, 2'", "CAST(x'7bff' AS TEXT)"}) {
    const std::string sql = "UPDATE campaign SET configuration = " + std::string(configuration);
    const auto database = open_for_reading(damage(sql));
    expect_bad_file(refusal([&] { read_campaign_of(*database, path()); }), "configuration", sql);
  }
}

TEST_F(DamageTest, WhatIsNoUtf8IsReplaced) {
  damage(
      "UPDATE campaign SET name = CAST(x'61ff62' AS TEXT); UPDATE candidate SET elongation = "
      "CAST(x'ff' AS TEXT)");
  const auto database = open_for_reading(path());
  EXPECT_EQ(read_state(*database).name,
            "a\xEF\xBF\xBD"
            "b");
  const Json row = read_candidate(*database, draws_of(*database, "candidate", {0, 4000}).front());
  EXPECT_EQ(row.at("elongation"), "\xEF\xBF\xBD");
}

TEST_F(DamageTest, VersionsThatNeverWereAreRefused) {
  for (const char* sql : {"PRAGMA user_version = 0", "PRAGMA user_version = -1"}) {
    damage(sql);
    expect_bad_file(refusal([&] { open_for_reading(path()); }), "is no catalogue", sql);
    expect_bad_file(refusal([&] { open(); }), "is no catalogue", sql);
  }
}

// A run that resumes: done(), begin_run with a goal that looks at the rows, and settling.
TEST_F(DamageTest, WritersStop) {
  const auto write_on = [&] {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, 4000}, {}, 1000});
    const std::uint64_t draw = catalogue.undecided().front();
    UnitRecord decided;
    decided.range = {draw, draw + 1};
    decided.rejected = 1;
    catalogue.settle(decided);
    catalogue.end_run("stopped");
  };
  damage("SELECT 1");
  EXPECT_EQ(refusal(write_on).cause, std::nullopt);
  const std::pair<const char*, const char*> kDamages[] = {
      {"UPDATE unit SET hi = 1 WHERE lo = 2000", "unit 2000 is no range"},
      {"UPDATE undecided SET unit = 17", "is undecided in no unit"},
      {"UPDATE campaign SET identity = replace(identity, '0', '1')", "its identity"},
      {"DELETE FROM campaign", "no campaign"},
      {"DROP TABLE screened", "screened"},
  };
  for (const auto& [sql, word] : kDamages) {
    damage(sql);
    expect_bad_file(refusal(write_on), word, sql);
  }
}

// Every cell of every page from some byte on is something else.
TEST_F(DamageTest, PagesAreRefused) {
  const std::string sql = "pages";
  damage("SELECT 1");
  {
    std::fstream file(path(), std::ios::in | std::ios::out | std::ios::binary);
    for (int page = 1; page < 6; ++page) {
      file.seekp(4096 * page);
      file << std::string(64, '\x7f');
    }
  }
  const auto database = open_for_reading(path());
  expect_bad_file(refusal([&] { read_state(*database); }), "is damaged", sql);
  expect_bad_file(refusal([&] { check_ledger(*database, campaign_); }), "is damaged", sql);
  const std::string all = "SELECT * FROM unit";
  expect_bad_file(refusal([&] { query_table(*database, all, TableStyle::csv); }), "is damaged",
                  sql);
}

}  // namespace
}  // namespace misalign::schema
