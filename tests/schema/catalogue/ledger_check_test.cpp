#include "schema/catalogue/ledger_check.hpp"

#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

class LedgerCheckTest : public CatalogueTest {
 protected:
  void write() {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, 6000}, {}, {}});
    for (const std::uint64_t lo : {0, 2000, 4000}) catalogue.commit({unit(lo, lo + 2000)});
    catalogue.end_run("complete");
  }
  std::vector<Finding> findings() { return check_ledger(*open_for_reading(path()), campaign_); }
  /// Whether some finding names this column after these statements, made past keys and checks.
  testing::AssertionResult finds(const std::string& sql, const std::string& column) {
    std::filesystem::remove(path());
    write();
    change_rows(path(), sql);
    std::string all;
    for (const Finding& finding : findings()) {
      if (finding.details.at("column") == column) return testing::AssertionSuccess();
      all += finding.sentence + "\n";
    }
    return testing::AssertionFailure() << "found only: " << all;
  }
};

TEST_F(LedgerCheckTest, GoodOnesRaiseNothing) {
  write();
  for (const Finding& finding : findings()) ADD_FAILURE() << finding.sentence;
  // Also where the goal's end cuts a unit.
  open().begin_run(kRun, {{0, 4500}, {}, {}});
  for (const Finding& finding : findings()) ADD_FAILURE() << finding.sentence;
}

// What nothing else compares: SQLite forgets the CHECKs of a file that it opens only to read.
TEST_F(LedgerCheckTest, RowsThatBreakACheckAreFound) {
  EXPECT_TRUE(
      finds("UPDATE unit SET worker = -7 WHERE lo = 2000", "rows that break (worker >= 0)"));
  EXPECT_TRUE(finds("UPDATE campaign SET id = 2", "rows that break (id = 1)"));
}

TEST_F(LedgerCheckTest, AscentsOfASearchThatDoesNotOptimiseAreFound) {
  EXPECT_TRUE(
      finds("INSERT INTO ascent SELECT draw, 1, 2, 3, 4, 'most_steps', NULL FROM candidate LIMIT 1",
            "rows of ascent"));
}

TEST_F(LedgerCheckTest, WhatIsAlteredIsNamed) {
  const std::string first = " WHERE draw = (SELECT min(draw) FROM candidate)";
  EXPECT_TRUE(finds("DELETE FROM candidate" + first, "accepted"));
  EXPECT_TRUE(finds("DELETE FROM candidate" + first, "digest_part"));
  EXPECT_TRUE(finds("DELETE FROM candidate" + first, "digest"));
  EXPECT_TRUE(finds("UPDATE candidate SET draw = draw + 1" + first, "digest_part"));
  EXPECT_TRUE(finds("UPDATE candidate SET draw = 2001" + first, "candidate.unit"));
  EXPECT_TRUE(finds("UPDATE candidate SET unit = 2000" + first, "candidate.unit"));
  EXPECT_TRUE(finds("UPDATE candidate SET unit = 3" + first, "key into unit"));
  EXPECT_TRUE(finds("UPDATE candidate SET deploys_from_sample = 176" + first, "digest_part"));
  for (const char* sample : {"7", "181", "deploys_from_sample + (1 << 32)"}) {
    EXPECT_TRUE(finds("UPDATE candidate SET deploys_from_sample = " + std::string(sample) + first,
                      "deploys_from_sample"));
  }
  EXPECT_TRUE(
      finds("PRAGMA writable_schema = ON; UPDATE sqlite_schema SET rootpage = (SELECT "
            "sum(rootpage) FROM sqlite_schema WHERE name IN ('candidate_by_deploys_from', "
            "'candidate_simplest')) - rootpage WHERE name IN ('candidate_by_deploys_from', "
            "'candidate_simplest')",
            "integrity_check"));
  EXPECT_TRUE(
      finds("UPDATE unit SET accepted = accepted + 1, rejected = rejected - 1 "
            "WHERE lo = 2000",
            "accepted"));
  EXPECT_TRUE(
      finds("UPDATE unit SET undecided = undecided + 1, rejected = rejected - 1 "
            "WHERE lo = 2000",
            "undecided"));
  EXPECT_TRUE(finds("UPDATE unit SET rejected = rejected + 1 WHERE lo = 0", "rejected"));
  EXPECT_TRUE(finds("UPDATE unit SET digest_part = zeroblob(16) WHERE lo = 0", "digest_part"));
  EXPECT_TRUE(finds("UPDATE unit SET hi = hi + 1, rejected = rejected + 1 WHERE lo = 0", "lo"));
  EXPECT_TRUE(finds("DELETE FROM undecided WHERE draw = 3", "undecided"));
  EXPECT_TRUE(finds("DELETE FROM fault_sample WHERE draw = 1024", "rows of fault_sample"));
  EXPECT_TRUE(finds("UPDATE fault_sample SET draw = 1025 WHERE draw = 1024", "fault_sample.draw"));
  EXPECT_TRUE(finds("UPDATE candidate SET draw = 3" + first, "verdict"));
  EXPECT_TRUE(finds("UPDATE unit SET hi = lo WHERE lo = 4000", "hi"));
  EXPECT_TRUE(
      finds("UPDATE campaign SET identity = replace(hex(zeroblob(16)), '0', 'a')", "identity"));
  EXPECT_TRUE(
      finds("CREATE TEMP TABLE another AS SELECT * FROM candidate LIMIT 1; "
            "UPDATE another SET draw = 11; INSERT INTO candidate SELECT * FROM another",
            "accepted"));
}

// What follows from the rest of it.
TEST_F(LedgerCheckTest, CampaignAndRunsAreWhatFollows) {
  EXPECT_TRUE(finds("UPDATE campaign SET goal_end = 0", "goal_end"));
  EXPECT_TRUE(finds("UPDATE campaign SET goal_end = 5999", "goal_end"));
  EXPECT_TRUE(finds("UPDATE campaign SET goal_accepted = 1", "goal_end"));  // met at 4096
  EXPECT_TRUE(finds("UPDATE campaign SET diagonals = '[]'", "diagonals"));
  EXPECT_TRUE(finds("UPDATE campaign SET diagonals = 'nonsense'", "diagonals"));
  EXPECT_TRUE(
      finds("UPDATE campaign SET diagonals = json_set(diagonals, '$[1].from', 'A1')", "diagonals"));
  EXPECT_TRUE(
      finds("UPDATE campaign SET diagonals = json_set(diagonals, '$[1].flat_mm', "
            "json_extract(diagonals, '$[1].flat_mm') + 1e-9)",
            "diagonals"));
  EXPECT_TRUE(finds("UPDATE unit SET worker = 2 WHERE lo = 0", "ranks"));  // of 0 and 1
  EXPECT_TRUE(finds("UPDATE run SET commits = 4", "commits"));
  EXPECT_TRUE(finds("UPDATE run SET longest_commit_s = 2 * commit_s + 1", "longest_commit_s"));
}

TEST_F(LedgerCheckTest, RunsSayNothingThatCannotBe) {
  EXPECT_TRUE(finds("UPDATE run SET started_at = 'yesterday'", "started_at"));
  EXPECT_TRUE(finds("UPDATE run SET ended_at = ''", "ended_at"));
  EXPECT_TRUE(finds("UPDATE run SET ended_at = NULL", "ended_at"));  // beside its end
  EXPECT_TRUE(finds("UPDATE run SET commits = -1", "commits"));
  EXPECT_TRUE(finds("UPDATE run SET longest_commit_s = -1", "longest_commit_s"));
  EXPECT_TRUE(finds("UPDATE run SET schema_version = " + std::to_string(kSchemaVersion + 1),
                    "schema_version"));
  EXPECT_TRUE(finds("UPDATE run SET schema_version = 0", "schema_version"));
  EXPECT_TRUE(finds("UPDATE run SET configuration = 'nonsense'", "configuration"));
  EXPECT_TRUE(finds("UPDATE run SET configuration = json_set(configuration, '$.seed', 2)",
                    "configuration"));
  for (const char* lie : {"-1", "9e999"}) {
    EXPECT_TRUE(finds("UPDATE unit SET seconds = " + std::string(lie), "seconds"));
  }
}

// Each rejected draw was rejected by one cause, at a sample of the path.
TEST_F(LedgerCheckTest, WhatWasScreenedIsWhatWasRejected) {
  EXPECT_TRUE(finds("UPDATE screened SET draws = draws + 1", "draws"));
  EXPECT_TRUE(finds("DELETE FROM screened", "draws"));
  EXPECT_TRUE(finds("INSERT INTO screened VALUES ('bump', 9, 1)", "draws"));
  EXPECT_TRUE(finds("UPDATE screened SET tested_deg = 8.5", "row"));
  EXPECT_TRUE(finds("UPDATE screened SET tested_deg = 181", "row"));
  EXPECT_TRUE(finds("UPDATE screened SET draws = -draws", "row"));
  // Of catalogues that were joined there may be more.
  std::filesystem::remove(path());
  write();
  change_rows(path(), "UPDATE screened SET draws = draws + 1; UPDATE run SET end = 'merged'");
  for (const Finding& finding : findings()) ADD_FAILURE() << finding.sentence;
}

TEST_F(LedgerCheckTest, WhatIsSampledIsAcceptedWhereItIsACandidate) {
  EXPECT_TRUE(finds("UPDATE fault_sample SET deploys_from_sample = 180 WHERE draw = 1024",
                    "fault_sample.accepted"));
  EXPECT_TRUE(finds("UPDATE fault_sample SET first_fault = 'undecided' WHERE draw = 1024",
                    "fault_sample.undecided"));
}

// A fault sample and a candidate are one draw's verdict.
TEST_F(LedgerCheckTest, FaultSampleAndCandidateAgree) {
  EXPECT_TRUE(
      finds("UPDATE candidate SET draw = 1024 WHERE draw = (SELECT max(draw) FROM "
            "candidate WHERE draw < 1024)",
            "fault_sample.deploys_from_sample"));
}

}  // namespace
}  // namespace misalign::schema
