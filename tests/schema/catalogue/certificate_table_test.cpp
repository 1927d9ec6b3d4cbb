// Certificates in a catalogue: what is kept, which of two is taken over, what is found to be
// changed, and that the rest of the catalogue is as it was.
#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/sheets_once.hpp"
#include "tests/older_catalogues.hpp"
#include "tests/schema/catalogue/certificate_fixture.hpp"

namespace misalign::schema {
namespace {

TEST_F(CertificateTest, AreKeptAndReplaced) {
  const CertificateRecord first = row(), other = row(claims(160, CertificateEnd::to_the_end), 102);
  keep({first, other});
  EXPECT_EQ(kept(5), first);
  EXPECT_EQ(kept(102), other);
  EXPECT_FALSE(kept(199));
  const CertificateRecord second = row(claims(20, CertificateEnd::over_folded));
  keep({second});
  EXPECT_EQ(kept(5), second);
  EXPECT_EQ(count("certificate"), 2);
  {
    Catalogue catalogue = open();
    EXPECT_EQ(catalogue.keep({row(6), row(102), row(7)}), (std::vector<std::uint64_t>{6, 7}));
    catalogue.close();
  }
  EXPECT_EQ(count("certificate"), 2) << "6 and 7 are no candidates";
  // Of the ledger nothing has changed.
  EXPECT_EQ(state().digest, expected({{0, 1000}}));
  EXPECT_TRUE(check_ledger(*open_for_reading(path()), campaign_).empty());
  EXPECT_TRUE(findings().empty());
  EXPECT_EQ(check_certificates(*open_for_reading(path()), campaign_).count, 2u);
}

TEST_F(CertificateTest, ComeWithTheirCandidate) {
  UnitRecord more = unit(1000, 2000);
  ASSERT_GE(more.candidates.size(), 2u);
  const std::uint64_t draw = more.candidates[1].draw;
  more.candidates[1].certificate = row(draw);
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 2000, {}});
    catalogue.commit({more});
    catalogue.end_run("complete");
  }
  EXPECT_EQ(kept(draw), row(draw));
  EXPECT_EQ(count("certificate"), 1);
  EXPECT_EQ(state().digest, expected({{0, 2000}}));
}

TEST_F(CertificateTest, WhatWasChangedInTheFileIsFound) {
  const std::string whole = path("whole.db");
  keep({row(), row(102)});
  std::filesystem::copy_file(path(), whole);
  for (const char* change : {"draw = 199",
                             "certified_deg = 170",
                             "asked_deg = 150.6",
                             "ended = 'to_the_end'",
                             "ended = 'nothing'",
                             "place = ''",
                             "place = 'A1-A2'",
                             "contact = 1",
                             "contact = 2",
                             "contact = 256",
                             "intervals = 3",
                             "intervals = intervals + 4294967296",
                             "intervals = -1",
                             "seconds = -1",
                             "seconds = 9e999",
                             "hash = upper(hash)",
                             "hash = ''",
                             "proof = zeroblob(0)",
                             "proof = zeroblob(100)",
                             "proof = CAST(substr(proof, 2) AS BLOB)",
                             "proof = CAST(proof || x'00' AS BLOB)"}) {
    std::filesystem::copy_file(whole, path(), std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(findings().empty());
    change_rows(path(), std::string("UPDATE certificate SET ") + change + " WHERE draw = 5");
    const auto found = findings();
    ASSERT_EQ(found.size(), 1u) << change;
    EXPECT_NE(found[0].sentence.find("certificate"), std::string::npos) << found[0].sentence;
  }
  // A candidate that is another sheet now, and one that is gone.
  for (const char* change :
       {"UPDATE candidate SET displacements_mm = '{\"A10\": [0.4, 0.1]}' WHERE draw = 5",
        "UPDATE candidate SET displacements_mm = '{\"A100\": [0.4, 0]}' WHERE draw = 5",
        "UPDATE candidate SET displacements_mm = 'x' WHERE draw = 5",
        "DELETE FROM candidate WHERE draw = 5"}) {
    std::filesystem::copy_file(whole, path(), std::filesystem::copy_options::overwrite_existing);
    change_rows(path(), change);
    const auto found = findings();
    ASSERT_EQ(found.size(), 1u) << change;
    EXPECT_EQ(found[0].details.at("where"), "draw 5") << change;
  }
}

TEST_F(CertificateTest, CandidatesAreFilteredAndSortedByThem) {
  keep({row(), row(claims(169, CertificateEnd::to_the_end), 102)});
  const auto draws = [&](const std::string& rest) {
    return query_table(*open_for_reading(path()), "SELECT draw FROM candidates " + rest,
                       TableStyle::csv);
  };
  EXPECT_EQ(draws("WHERE certified_deg >= 160"), "draw\n102\n");
  EXPECT_EQ(draws("WHERE certified_deg IS NOT NULL ORDER BY certified_deg"), "draw\n5\n102\n");
  EXPECT_EQ(draws("WHERE draw = 199 AND certified_deg IS NULL"), "draw\n199\n");
}

TEST_F(CertificateTest, GoWithTheirCandidate) {
  keep({row(), row(102), row(199)});
  {
    const auto database = open_for_writing(path(), Storage::local);
    // 102 is the same sheet as 5, found again.
    database->exec("INSERT INTO sheet (draw, hash) VALUES (5, zeroblob(16)), (102, zeroblob(16))");
    SQLite::Transaction transaction(*database);
    keep_each_sheet_once(*database, campaign_, mechanism_, {0, kEndOfDraws});
    transaction.commit();
  }
  EXPECT_EQ(count("candidate WHERE draw = 102"), 0);
  EXPECT_TRUE(kept(5));
  EXPECT_FALSE(kept(102));
  EXPECT_TRUE(kept(199));
}

// Of two of one candidate one stays, whichever was there first.
TEST_F(CertificateTest, TheStrongerOneIsTakenOver) {
  solver::Certificate touching = claims(100);
  touching.contact = true;
  const CertificateRecord weak = row(claims(100)), strong = row(claims(120)), apart = row(touching);
  CertificateRecord spoilt = row(claims(160)), as_strong = strong;
  spoilt.hash[0] = spoilt.hash[0] == 'a' ? 'b' : 'a';
  as_strong.seconds = 99;
  struct Case {
    std::optional<CertificateRecord> there, other;
    CertificateRecord stays;
  };
  const Case kCases[] = {
      {{}, weak, weak},       {weak, strong, strong}, {strong, weak, strong},
      {strong, apart, apart}, {apart, strong, apart}, {strong, as_strong, strong},
      {weak, spoilt, weak},   {spoilt, weak, weak},   {as_strong, strong, as_strong}};
  for (const Case& c : kCases) {
    for (const char* name : {"into.db", "from.db"}) {
      std::filesystem::copy_file(path(), path(name),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    if (c.there) keep({*c.there}, "into.db");
    if (c.other) keep({*c.other}, "from.db");
    {
      const auto from = open_for_reading(path("from.db"));
      Catalogue into = open("into.db");
      EXPECT_EQ(into.take_over_certificates(*from), c.other == spoilt ? 1u : 0u);
      into.close();
    }
    EXPECT_EQ(kept(5, "into.db"), c.stays) << &c - kCases;
  }
}

TEST_F(CertificateTest, OfOtherCandidatesNoneIsTakenOver) {
  keep({row(), row(102)});
  {
    const auto from = open_for_reading(path());
    Catalogue into = open("into.db");
    into.begin_run(kRun, {{0, kEndOfDraws}, 1000, {}});
    into.commit({unit(0, 100)});  // 5 alone
    EXPECT_EQ(into.take_over_certificates(*from), 0u);
    into.end_run("complete");
  }
  EXPECT_EQ(kept(5, "into.db"), row());
  EXPECT_EQ(count("certificate", "into.db"), 1);
}

TEST_F(CertificateTest, OlderCataloguesHaveNoneUntilTheyAreBroughtUpToDate) {
  for (const OlderCatalogue& fixture : kOlderCatalogues) {
    const std::string old = path("old.db");
    std::filesystem::copy_file(fixture.path(), old,
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::remove(old + ".version-" + std::to_string(fixture.version));
    const Campaign campaign = read_campaign_of(*open_for_reading(old), old);
    const solver::Mechanism mechanism = mechanism_of(campaign);
    std::uint64_t draw = 0;
    std::string digest;
    {
      const auto database = open_for_reading(old);
      draw = draw_of(database->execAndGet("SELECT min(draw) FROM candidate"));
      digest = read_state(*database).digest;
      EXPECT_FALSE(read_certificate(*database, draw));
      EXPECT_EQ(check_certificates(*database, campaign).count, 0u);
      EXPECT_EQ(database->execAndGet("SELECT count(certified_deg) FROM candidates").getInt(), 0);
      EXPECT_EQ(database->execAndGet("SELECT count(*) FROM certificate").getInt(), 0);
    }
    const solver::Certificate nothing{170, {}, CertificateEnd::flat_branch, -1, false, {}, {}};
    const CertificateRecord row = certificate_row(
        campaign.pattern, mechanism, draw,
        Eigen::Matrix2Xd::Zero(2, campaign.pattern.base.sheet.vertex_count()), nothing, 0.5);
    {
      Catalogue catalogue(old, campaign, mechanism);
      EXPECT_TRUE(catalogue.keep({row}).empty());
      catalogue.close();
    }
    EXPECT_EQ(kept(draw, "old.db"), row) << fixture.name;
    EXPECT_EQ(state("old.db").digest, digest) << fixture.name;
  }
}

}  // namespace
}  // namespace misalign::schema
