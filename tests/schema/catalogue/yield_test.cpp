// Yields of miscut copies: what is kept, what replaces what, and what is found wrong with them.
#include "schema/catalogue/yield.hpp"

#include <boost/math/special_functions/beta.hpp>

#include "schema/catalogue/ledger_check.hpp"
#include "schema/catalogue/metric_table.hpp"
#include "schema/catalogue/named_queries.hpp"
#include "tests/older_catalogues.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

class YieldTest : public CatalogueTest {
 protected:
  void SetUp() override {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    catalogue.commit({unit(0, 4096)});
    catalogue.end_run("complete");
  }
  void keep(const std::vector<Yield>& yields, const std::string& name = "a.db") const {
    Catalogue catalogue = open(name);
    catalogue.keep(yields, "this build");
    catalogue.close();
  }
  std::vector<Yield> kept(std::uint64_t draw, const std::string& name = "a.db") const {
    return read_yields(*open_for_reading(path(name)), draw);
  }
  /// Whatever it takes, as another program might.
  void alter(const std::string& sql) const {
    SQLite::Database database(path(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF; " + sql);
  }
};

TEST_F(YieldTest, MoreTrialsReplaceFewer) {
  const Yield first{5, 0.05, 100, 90, 2}, more{5, 0.05, 200, 150, 0}, fewer{5, 0.05, 50, 50, 0},
      as_many{5, 0.05, 200, 160, 0}, other{5, 0.1, 30, 3, 0};
  keep({first, other});
  EXPECT_EQ(kept(5), (std::vector{first, other}));
  keep({more});
  EXPECT_EQ(kept(5), (std::vector{more, other}));
  keep({fewer, as_many});
  EXPECT_EQ(kept(5), (std::vector{more, other}));
  EXPECT_TRUE(kept(102).empty());
  keep({{6, 0.05, 10, 10, 0}});
  EXPECT_TRUE(kept(6).empty()) << "6 is no candidate";
  EXPECT_EQ(count("yield"), 2);
  // Of the ledger nothing has changed.
  EXPECT_EQ(state().digest, expected({{0, 4096}}));
  EXPECT_TRUE(check_ledger(*open_for_reading(path()), campaign_).empty());
}

// Those from another angle are rows of their own, and not the column `yield`.
TEST_F(YieldTest, FromAnotherAngleAreOthers) {
  const Yield threshold{5, 0.05, 100, 90, 2}, mine{5, 0.05, 100, 99, 0, 40.5},
      more{5, 0.05, 200, 150, 0, 40.5};
  keep({threshold, mine});
  EXPECT_EQ(kept(5), (std::vector{mine, threshold}));
  keep({more});
  EXPECT_EQ(kept(5), (std::vector{more, threshold}));
  const auto database = open_for_reading(path());
  EXPECT_EQ(database->execAndGet("SELECT yield FROM candidates WHERE draw = 5").getDouble(),
            90. / 98);
  EXPECT_EQ(database->execAndGet("SELECT max(from_deg) FROM yields").getDouble(),
            campaign_.threshold_deg);
  EXPECT_FALSE(yield_json(threshold).contains("from_deg"));
  EXPECT_EQ(yield_json(mine)["from_deg"], 40.5);
  EXPECT_TRUE(check_yields(*database).empty());
  // As a merge takes them.
  {
    Catalogue other = open("b.db");
    other.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    other.commit({unit(0, 4096)});
    other.end_run("complete");
  }
  SQLite::Database into(path("b.db"), SQLite::OPEN_READWRITE);
  copy_yields(*database, into);
  EXPECT_EQ(kept(5, "b.db"), (std::vector{more, threshold}));
}

// Yields of version 7 are those of the threshold: as they are read, and once they are brought up to
// date.
TEST_F(YieldTest, OlderOnesAreOfTheThreshold) {
  std::filesystem::copy_file(std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7.db",
                             path("old.db"));
  const int draw =
      SQLite::Database(path("old.db")).execAndGet("SELECT min(draw) FROM candidate").getInt();
  SQLite::Database(path("old.db"), SQLite::OPEN_READWRITE)
      .exec("INSERT INTO yield VALUES (" + std::to_string(draw) +
            ", 0.05, 40, 30, 0, 0.75, 0.5, 0.9, 'none', '2026')");
  const auto expect_there = [&] {
    const auto database = open_for_reading(path("old.db"));
    const Yield yield{static_cast<std::uint64_t>(draw), 0.05, 40, 30, 0};
    EXPECT_EQ(read_yields(*database, yield.draw), std::vector{yield});
    EXPECT_EQ(database->execAndGet("SELECT from_deg FROM yields").getDouble(), 150);
    EXPECT_EQ(database->execAndGet("SELECT max(yield) FROM candidates").getDouble(), 0.75);
  };
  expect_there();
  const Campaign its = read_campaign_of(*open_for_reading(path("old.db")), "old.db");
  const solver::PerforatedSheet& base = its.pattern.base;
  Catalogue(path("old.db"), its, solver::build_mechanism(base)).close();
  EXPECT_EQ(version_of(*open_for_reading(path("old.db"))), kSchemaVersion);
  expect_there();
}

// Whoever keeps something in a catalogue that went away meanwhile makes no empty one in its place.
TEST_F(YieldTest, WhatIsGoneIsSaid) {
  {
    Catalogue catalogue = open();
    EXPECT_EQ(catalogue.keep({{5, 0.05, 10, 9, 0}, {6, 0.05, 10, 9, 0}, {7, 0.05, 10, 9, 0}}, "b"),
              (std::vector<std::uint64_t>{6, 7}));
    EXPECT_TRUE(catalogue.keep({{5, 0.05, 5, 4, 0}}, "b").empty()) << "fewer trials";
    catalogue.close();
  }
  const auto open_again = [&] {
    return refusal([&] { Catalogue(path(), campaign_, mechanism_, {}, Missing::refused); });
  };
  EXPECT_EQ(open_again().sentence, "");
  std::filesystem::remove(path());
  EXPECT_EQ(open_again().cause, Cause::bad_input);
  EXPECT_FALSE(std::filesystem::exists(path()));
  std::ofstream(path()).close();
  EXPECT_EQ(open_again().cause, Cause::bad_input);
  EXPECT_EQ(std::filesystem::file_size(path()), 0u);
}

// In one file, which a directory that nobody may write to can hold.
TEST_F(YieldTest, TheFileIsOneAgain) {
  keep({{5, 0.05, 100, 90, 0}});
  EXPECT_EQ(SQLite::Database(path()).execAndGet("PRAGMA journal_mode").getString(), "delete");
  EXPECT_FALSE(std::filesystem::exists(path() + "-wal"));
}

TEST_F(YieldTest, SharesAndIntervalsAreThoseOfTheCounts) {
  keep({{5, 0.05, 12, 6, 2}});
  const auto database = open_for_reading(path());
  const Json row =
      Json::parse(query_table(*database, "SELECT * FROM yields", TableStyle::json)).at(0);
  EXPECT_DOUBLE_EQ(row.at("share").get<double>(), 0.6);
  // Clopper and Pearson's bounds, the undecided ones counted both ways.
  EXPECT_NEAR(row.at("share_low").get<double>(), boost::math::ibeta_inv(6, 7, 0.025), 1e-12);
  EXPECT_NEAR(row.at("share_high").get<double>(), boost::math::ibeta_inv(9, 4, 0.975), 1e-12);
  const Json exported = yield_json(kept(5).front());
  for (const auto& [key, value] : exported.items()) EXPECT_EQ(row.at(key), value) << key;
}

// Rows can be compared: all yields in `candidates` are at one amplitude.
TEST_F(YieldTest, CandidatesShowTheCommonAmplitude) {
  const auto column = [&](const std::string& name) {
    return query_table(*open_for_reading(path()),
                       "SELECT draw, " + name + " FROM candidates WHERE " + name +
                           " IS NOT NULL ORDER BY yield DESC",
                       TableStyle::csv);
  };
  EXPECT_EQ(column("yield"), "draw,yield\n");
  keep({{5, 0.05, 100, 90, 0}, {102, 0.05, 100, 95, 0}, {199, 0.2, 100, 10, 0}});
  EXPECT_EQ(column("yield"), "draw,yield\n102,0.95\n5,0.9\n");
  EXPECT_EQ(column("yield_amplitude_mm"), "draw,yield_amplitude_mm\n102,0.05\n5,0.05\n");
  keep({{5, 0.2, 100, 20, 0}, {102, 0.2, 100, 5, 0}});
  EXPECT_EQ(column("yield"), "draw,yield\n5,0.2\n199,0.1\n102,0.05\n");
}

TEST_F(YieldTest, TheQueryShowsTheBestOfEveryAmplitude) {
  const std::uint64_t first = 5;
  std::vector<Yield> yields;
  for (std::uint64_t k = 0; k < 25; ++k) yields.push_back({first + 97 * k, 0.05, 100, 60 + k, 0});
  for (const std::uint64_t draw : {first, first + 97}) yields.push_back({draw, 0.2, 100, 10, 0});
  keep(yields);
  const Json rows =
      Json::parse(query_table(*open_for_reading(path()), named_query("yields"), TableStyle::json));
  ASSERT_EQ(rows.size(), 22u);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_EQ(rows[k].at("amplitude_mm"), 0.05);
    EXPECT_EQ(rows[k].at("survivors"), 84 - k);
  }
  EXPECT_EQ(rows[20].at("draw"), first);
  EXPECT_EQ(rows[21].at("draw"), first + 97);
}

TEST_F(YieldTest, MergedOnesAreTheLargerOfBoth) {
  {
    Catalogue other = open("b.db");
    other.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    other.commit({unit(4096, 8192)});
  }
  const std::uint64_t there = 4096 + 97 - (4096 - 5) % 97;  // a candidate of the other one
  ASSERT_TRUE(is_accepted(there));
  keep({{there, 0.05, 10, 4, 0}}, "b.db");
  keep({{5, 0.05, 100, 90, 0}});
  Catalogue catalogue = open();
  catalogue.take_over_yields(*open_for_reading(path("b.db")));
  EXPECT_TRUE(kept(there).empty()) << "it is not in this one";
  catalogue.take_over(*open_for_reading(path("b.db")), {{4096, 8192}});
  for (int times = 0; times < 2; ++times) {
    catalogue.take_over_yields(*open_for_reading(path("b.db")));
    EXPECT_EQ(kept(there), (std::vector<Yield>{{there, 0.05, 10, 4, 0}}));
    EXPECT_EQ(kept(5), (std::vector<Yield>{{5, 0.05, 100, 90, 0}}));
  }
}

TEST_F(YieldTest, WhatCannotHaveBeenCountedIsFound) {
  keep({{5, 0.05, 100, 90, 4}, {102, 0.05, 100, 0, 0}});
  const std::pair<const char*, const char*> kAlterations[] = {
      {"UPDATE yield SET survivors = 97 WHERE draw = 5", "survivors"},
      {"UPDATE yield SET survivors = -1 WHERE draw = 5", "survivors"},
      {"UPDATE yield SET trials = 80 WHERE draw = 5", "survivors"},
      {"UPDATE yield SET survivors = 91 WHERE draw = 5", "share"},
      {"UPDATE yield SET share = NULL WHERE draw = 5", "share"},
      {"UPDATE yield SET share_low = 0 WHERE draw = 5", "share_low"},
      {"UPDATE yield SET share_high = 1 WHERE draw = 5", "share_high"},
      {"UPDATE yield SET draw = 6 WHERE draw = 5", "yield.draw"},
  };
  for (const auto& [sql, named] : kAlterations) {
    const std::string whole = path("whole.db");
    std::filesystem::copy_file(path(), whole, std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(check_yields(*open_for_reading(path())).empty());
    alter(sql);
    const auto findings = check_yields(*open_for_reading(path()));
    ASSERT_FALSE(findings.empty()) << sql;
    EXPECT_NE(findings.front().sentence.find(named), std::string::npos)
        << findings.front().sentence;
    EXPECT_FALSE(check_ledger(*open_for_reading(path()), campaign_).empty()) << sql;
    std::filesystem::copy_file(whole, path(), std::filesystem::copy_options::overwrite_existing);
  }
}

// Whoever exports a candidate is told so, and not what a library says of impossible numbers.
TEST_F(YieldTest, WhatDoesNotAddUpIsNotRead) {
  for (const char* parts :
       {"survivors = 9, undecided = -2, trials = 5", "survivors = 101", "undecided = 11",
        "trials = 0", "survivors = -1", "trials = -1, survivors = -2, undecided = 0"}) {
    keep({{5, 0.05, 200, 90, 0}});
    alter("UPDATE yield SET trials = 100, survivors = 90, undecided = 0; UPDATE yield SET " +
          std::string(parts));
    const Refusal r = refusal([&] { kept(5); });
    EXPECT_EQ(r.cause, Cause::bad_input) << parts;
    EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
    EXPECT_NE(r.sentence.find("draw 5"), std::string::npos) << r.sentence;
    alter("DELETE FROM yield");
  }
}

// A catalogue of an older schema answers today's questions, and stays as it is.
TEST_F(YieldTest, OlderCataloguesHaveNone) {
  for (const OlderCatalogue& fixture : kOlderCatalogues) {
    const std::string old = fixture.path();
    const auto database = open_for_reading(old);
    for (const char* name :
         {"best", "tolerant", "yields", "smooth", "simplest", "stroke", "strongest"}) {
      const Refusal r =
          refusal([&] { query_table(*database, named_query(name), TableStyle::json); });
      EXPECT_EQ(r.sentence, "") << name << ", " << old;
    }
    EXPECT_TRUE(read_yields(*database, 0).empty());
    EXPECT_TRUE(check_yields(*database).empty());
    EXPECT_GT(database->execAndGet("SELECT count(*) FROM candidates").getInt(), 10);
    const int margins =
        database->execAndGet("SELECT count(miscut_margin_mm) FROM candidates").getInt();
    EXPECT_EQ(margins > 0, fixture.first >= find_metric("miscut_margin_mm")->schema_since);
    EXPECT_EQ(database->execAndGet("SELECT count(yield) FROM candidates").getInt(), 0);
  }
}

}  // namespace
}  // namespace misalign::schema
