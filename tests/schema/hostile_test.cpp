// Catalogues made to harm whoever opens them. Each of these went through once.
#include <sqlite3.h>
#include <sys/stat.h>

#include <cstdlib>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/connection.hpp"
#include "schema/catalogue/sql_tokens.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/bench/cpu_seconds.hpp"
#include "tests/older_catalogues.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

class HostileTest : public CatalogueTest {
 protected:
  void write_good() const {
    std::filesystem::remove(path());
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, 4000}, {}, {}});
    catalogue.commit({unit(0, 2000)});
    catalogue.end_run("stopped");
  }
  // A campaign with gaps, and this done to it by whatever can write SQLite files.
  void attack(const std::string& sql) const {
    write_good();
    SQLite::Database(path(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE).exec(sql);
  }
  // By those who read it and those who write it, in a sentence with this word.
  void expect_refused(const std::string& word, const std::string& attack) {
    for (const Refusal& r :
         {refusal([&] { open_for_reading(path()); }), refusal([&] { open(); })}) {
      EXPECT_EQ(r.cause, Cause::bad_input) << attack << ": " << r.sentence;
      EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
      EXPECT_NE(r.sentence.find(word), std::string::npos) << attack << ": " << r.sentence;
    }
  }
};

TEST_F(HostileTest, WhatTheProgramDoesNotWriteIsNamedAndRefused) {
  const std::pair<const char*, const char*> kAttacks[] = {
      // A campaign that is complete as soon as anybody goes on with it.
      {"CREATE TRIGGER quiet AFTER INSERT ON unit BEGIN UPDATE campaign SET goal_end = 0; END",
       "trigger quiet on unit is foreign"},
      // Units that are never written.
      {"CREATE TRIGGER lazy BEFORE INSERT ON unit BEGIN SELECT RAISE(IGNORE); END",
       "trigger lazy on unit is foreign"},
      {"DROP TRIGGER unit_overlaps", "trigger unit_overlaps is missing"},
      {"DROP TRIGGER unit_moves; CREATE TRIGGER unit_moves BEFORE UPDATE OF lo ON unit BEGIN "
       "SELECT "
       "1; END",
       "trigger unit_moves is another"},
      {"CREATE VIEW spy AS SELECT load_extension('x')", "view spy is foreign"},
      {"DROP VIEW candidates; CREATE VIEW candidates AS SELECT 1 AS draw",
       "view candidates is another"},
      {"DROP VIEW gaps; CREATE VIEW gaps AS SELECT 1 AS lo, 2 AS hi WHERE 0",
       "view gaps is another"},
      {"CREATE VIRTUAL TABLE words USING fts3(x, tokenize=simple)", "table words is foreign"},
      {"CREATE TABLE mine (x)", "table mine is foreign"},
      {"ALTER TABLE unit ADD COLUMN more TEXT DEFAULT 'x'", "column more of table unit is foreign"},
      {"CREATE INDEX mine ON candidate (abs(draw))", "index mine on candidate is foreign"},
      {"DROP INDEX candidate_by_deploys_from", "index candidate_by_deploys_from is missing"},
      {"PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, 'CHECK (hi > "
       "lo)', "
       "'') WHERE name = 'unit'",
       "column hi of table unit is another"},
      {"PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, ') STRICT', ')') "
       "WHERE name = 'unit'",
       "table unit is another"},
      {"PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = sql || ' /* open' WHERE name = "
       "'gaps'",
       "view gaps is another"},
      // SQLite reads a definition up to a zero byte: without the condition, here.
      {"PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, 'WHERE lo > "
       "previous_hi', '--' || char(0) || char(10) || 'WHERE lo > previous_hi') WHERE name = 'gaps'",
       "view gaps is another"},
      {"ANALYZE; PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = sql || '--' || "
       "char(0) "
       "|| char(10) WHERE name = 'sqlite_stat1'",
       "sqlite_stat1 is foreign"},
  };
  for (const auto& [sql, named] : kAttacks) {
    attack(sql);
    expect_refused(named, sql);
  }
  attack("CREATE VIEW \"a\x1b[2Jb\" AS SELECT 1");
  const std::string said = refusal([&] { open_for_reading(path()); }).sentence;
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
}

// SQLite lets a row stand as often as one likes where it has no definition.
TEST_F(HostileTest, RowsThatAreThereTwiceCostNothing) {
  attack(
      "PRAGMA writable_schema = ON; WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 "
      "FROM n WHERE k < 2000) INSERT INTO sqlite_schema SELECT type, name, tbl_name, rootpage, "
      "NULL FROM sqlite_schema, n WHERE name = 'candidate_best'");
  const double begin_s = bench::cpu_seconds();
  const Refusal r = refusal([&] { open_for_reading(path()); });
  const double cpu_s = bench::cpu_seconds() - begin_s;
  EXPECT_EQ(r.cause, Cause::bad_input);
  EXPECT_NE(r.sentence.find("index candidate_best occurs twice"), std::string::npos) << r.sentence;
  EXPECT_LT(r.sentence.size(), 1000u);
  EXPECT_LT(cpu_s, 2);  // 0.02 s, where each was looked up among all others 4 s
}

// Blanks, comments and what ANALYZE leaves do not count; nor where a version came from.
TEST_F(HostileTest, WhatDoesNotMatterIsNotHeldAgainstIt) {
  for (const char* sql :
       {"SELECT 1", "ANALYZE", "VACUUM",
        "PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(sql, char(10), "
        "char(9) "
        "|| '/* what was ' || char(10) || ' said */') WHERE sql NOT LIKE '%--%'"}) {
    attack(sql);
    EXPECT_EQ(refusal([&] { open_for_reading(path()); }).sentence, "") << sql;
    EXPECT_EQ(refusal([&] { open(); }).sentence, "") << sql;
  }
}

// Debian's SQLite has fts3_tokenizer switched on: with one argument it tells an address of the
// process, with two it calls any.
TEST_F(HostileTest, StatementsCallKnownFunctionsOnly) {
  write_good();
  const auto database = open_for_reading(path());
  for (const char* sql :
       {"SELECT hex(fts3_tokenizer('simple'))",
        "SELECT fts3_tokenizer('simple', x'4141414141414141')", "SELECT load_extension('x')",
        "SELECT sqlite_log(1, 'x')", "SELECT rtreecheck('unit')", "SELECT * FROM dbstat",
        "SELECT count(*) FROM dbstat", "SELECT * FROM sqlite_stmt",
        "SELECT * FROM fts3tokenize('simple', 'a b')", "SELECT * FROM pragma_function_list",
        "SELECT * FROM pragma_database_list", "SELECT length(zeroblob(1000000000))",
        "SELECT length(randomblob(1000000000))", "UPDATE sqlite_schema SET type = 'x'",
        "PRAGMA trusted_schema = ON", "PRAGMA user_version = 2"}) {
    EXPECT_EQ(refusal([&] { query_table(*database, sql, TableStyle::csv); }).cause,
              Cause::bad_request)
        << sql;
  }
  for (const char* sql :
       {"SELECT sum(draw), avg(draw) FILTER (WHERE draw > 1), group_concat(draw) FROM candidate",
        "SELECT draw, rank() OVER (ORDER BY draw), lag(draw) OVER () FROM candidate",
        "SELECT sqrt(2), pi(), round(2.5), atan2(1, 2), 7 % 3, mod(7, 3), ceil(1.5)",
        "SELECT date('now'), strftime('%Y', 'now'), julianday('now')",
        "SELECT upper('a') || 'b' LIKE 'A%', 'a' GLOB '*', substr('abc', 2), printf('%d', 1)",
        "SELECT json_extract('[1]', '$[0]'), '[1]' ->> 0, json_group_array(draw) FROM candidate",
        "SELECT key, value FROM json_each('[1, 2]')", "SELECT * FROM sqlite_schema",
        "WITH best AS (SELECT 1 AS x) SELECT count(*) FROM best",
        "SELECT name FROM pragma_table_info('unit')", "PRAGMA user_version",
        "SELECT * FROM displacements", "SELECT * FROM diagonals",
        "WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n WHERE k < 9) SELECT k "
        "FROM n"}) {
    EXPECT_EQ(refusal([&] { query_table(*database, sql, TableStyle::csv); }).sentence, "") << sql;
  }
}

// No name of ours is one of a module, or SQLite's own.
TEST_F(HostileTest, AllThatACatalogueHasIsRead) {
  write_good();
  std::vector<std::string> files{path()};
  for (const OlderCatalogue& fixture : kOlderCatalogues) files.push_back(fixture.path());
  for (const std::string& file : files) {
    const auto database = open_for_reading(file);
    SQLite::Statement row(*database,
                          "SELECT name FROM sqlite_schema WHERE type IN ('table', 'view')");
    int relations = 0;
    for (; row.executeStep(); ++relations) {
      const std::string sql = "SELECT * FROM main." + row.getColumn(0).getString() + " LIMIT 1";
      EXPECT_EQ(refusal([&] { query_table(*database, sql, TableStyle::csv); }).sentence, "") << sql;
    }
    EXPECT_GE(relations, 13) << file;
  }
}

TEST_F(HostileTest, EveryConnectionIsSafe) {
  write_good();
  const auto option = [](SQLite::Database& database, int which) {
    int value = -1;
    sqlite3_db_config(database.getHandle(), which, -1, &value);
    return value;
  };
  const auto memory = connect_to_memory();
  const auto reader = open_for_reading(path()), writer = open_for_writing(path(), Storage::local);
  for (SQLite::Database* database : {memory.get(), reader.get(), writer.get()}) {
    EXPECT_EQ(option(*database, SQLITE_DBCONFIG_ENABLE_FTS3_TOKENIZER), 0);
    EXPECT_EQ(option(*database, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION), 0);
    EXPECT_EQ(option(*database, SQLITE_DBCONFIG_DEFENSIVE), 1);
    EXPECT_THROW(database->execAndGet("SELECT fts3_tokenizer('simple')"), SQLite::Exception);
    EXPECT_THROW(database->exec("CREATE VIRTUAL TABLE t USING fts3(x)"), SQLite::Exception);
  }
}

TEST_F(HostileTest, TheBanIsBackWhateverHappens) {
  write_good();
  const auto database = open_for_reading(path());
  const std::string sql = "CREATE TEMP VIEW mine AS SELECT 1 AS x";
  EXPECT_THROW(database->exec(sql), SQLite::Exception);
  as_our_own(*database, [&] { database->exec(sql); });
  EXPECT_THROW(database->exec("DROP VIEW mine"), SQLite::Exception);
  EXPECT_THROW(as_our_own(*database, [&] { database->exec("CREATE TEMP VIEW mine AS nonsense"); }),
               SQLite::Exception);
  EXPECT_THROW(database->exec("DROP VIEW mine"), SQLite::Exception);
}

// A name is a name: SQLite would take these for a database in memory, or a second way into one.
TEST_F(HostileTest, NamesAreNoUris) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  for (const std::string name : {":memory:", "file:a.db?mode=memory", "file:b.db?vfs=unix-none"}) {
    {
      Catalogue catalogue(name, campaign_, mechanism_);
      catalogue.begin_run(kRun, {{0, 4000}, {}, {}});
      catalogue.commit({unit(0, 100)});
      catalogue.end_run("stopped");
    }
    EXPECT_GT(std::filesystem::file_size(path(name)), 4096u) << name;
    EXPECT_EQ(state(name).draws, 100u) << name;
    EXPECT_EQ(read_state(*open_for_reading(name)).draws, 100u) << name;
  }
  EXPECT_FALSE(std::filesystem::exists("a.db") || std::filesystem::exists("b.db"));
  std::filesystem::current_path(before);
}

TEST_F(HostileTest, FilesOfTwoNamesAreNotWritten) {
  write_good();
  std::filesystem::create_hard_link(path(), path("twin.db"));
  const Refusal twin = refusal([&] { open("twin.db"); });
  EXPECT_EQ(twin.cause, Cause::failure);
  EXPECT_NE(twin.sentence.find("has 2 names"), std::string::npos) << twin.sentence;
  EXPECT_EQ(state("twin.db").draws, 2000u);  // a backup made of links is read
  std::filesystem::remove(path("twin.db"));
  EXPECT_EQ(refusal([&] { open(); }).sentence, "");
  ASSERT_EQ(::mkfifo(path("pipe.db").c_str(), 0600), 0);
  EXPECT_EQ(refusal([&] { open("pipe.db"); }).cause, Cause::bad_input);
}

// The end of a journal as SQLite's pager.c writes it: the number of a page, the name, its length,
// its checksum, and eight bytes.
std::string journal_naming(const std::string& file) {
  const auto number = [](std::uint32_t n) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift & 255);
    return bytes;
  };
  std::uint32_t sum = 0;
  for (const char c : file) sum += static_cast<std::uint32_t>(c);
  const std::string magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::string header = magic + number(0) + number(1) + number(1) + number(512) + number(4096);
  header.resize(512, '\0');
  return header + number(262145) + file + number(static_cast<std::uint32_t>(file.size())) +
         number(sum) + magic;
}

// SQLite deletes what such a journal names.
TEST_F(HostileTest, JournalsThatNameFilesAreRefused) {
  const std::string victim = path("precious.txt");
  for (const bool through_link : {false, true}) {
    write_good();
    std::ofstream(victim) << "precious";
    std::ofstream(path() + "-journal", std::ios::binary) << journal_naming(victim);
    const std::string name = through_link ? "link.db" : "a.db";
    if (through_link) std::filesystem::create_symlink(path(), path(name));
    for (const Refusal& r :
         {refusal([&] { open_for_reading(path(name)); }), refusal([&] { open(name); })}) {
      EXPECT_EQ(r.cause, Cause::bad_input) << r.sentence;
      EXPECT_NE(r.sentence.find("a.db-journal"), std::string::npos) << r.sentence;
    }
    EXPECT_TRUE(std::filesystem::exists(victim));
    if (!through_link) std::filesystem::remove(path() + "-journal");
  }
  // So that it is known what is prevented.
  { SQLite::Database(path(), SQLite::OPEN_READWRITE).tryExec("SELECT * FROM campaign"); }
  EXPECT_FALSE(std::filesystem::exists(victim));
}

TEST_F(HostileTest, WhatLiesBesideACatalogueIsNotWaitedFor) {
  for (const char* suffix : {"-journal", "-wal", "-shm"}) {
    write_good();
    ASSERT_EQ(::mkfifo((path() + suffix).c_str(), 0600), 0);
    expect_refused("no regular file", suffix);
    std::filesystem::remove(path() + suffix);
  }
}

// What a catalogue or an exported candidate holds opens no file.
TEST_F(HostileTest, StoredConfigurationsNameNoFiles) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& name :
       {path("pipe"), std::string("/etc/passwd"), std::string("/dev/zero")}) {
    Json configuration = campaign_json(campaign_);
    configuration["pattern"] = {{"family", "fold"}, {"file", name}};
    write_good();
    change_rows(path(), "UPDATE campaign SET configuration = '" + configuration.dump() + "'");
    const Refusal kept = refusal([&] { read_campaign_of(*open_for_reading(path()), path()); });
    EXPECT_EQ(kept.cause, Cause::bad_input) << kept.sentence;
    EXPECT_NE(kept.sentence.find("no other file is opened"), std::string::npos) << kept.sentence;
    const std::string exported = path("draw-1.json");
    std::ofstream(exported) << Json{{"draw", 1}, {"pattern", configuration["pattern"]}};
    const Refusal carried = refusal([&] { read_sampled_pattern_file(exported); });
    EXPECT_NE(carried.sentence.find("no other file is opened"), std::string::npos)
        << carried.sentence;
  }
  // A campaign of one's own names files, and those only.
  for (const std::string& name :
       {path("pipe"), std::string("/dev/zero"), folder_.path().string()}) {
    std::ofstream(path("own.json")) << Json{{"pattern", {{"family", "fold"}, {"file", name}}}};
    const Refusal own = refusal([&] { read_campaign_file(path("own.json")); });
    EXPECT_EQ(own.cause, Cause::bad_input) << own.sentence;
    EXPECT_NE(own.sentence.find("no regular file"), std::string::npos) << own.sentence;
  }
  std::ofstream(path("large.json")) << std::string((64 << 20) + 1, ' ');
  EXPECT_NE(
      refusal([&] { read_campaign_file(path("large.json")); }).sentence.find("larger than 64 MB"),
      std::string::npos);
}

TEST(SqlTokens, ConditionsStandByThemselves) {
  for (const char* good : {"1", "a < 2", "(a)", "a IN (1, 2)", "t = ')'", "t = '--' AND 1",
                           "\"a(\" = 1", "[a)] = 1", "`a'` = 1", "1 -- all )", "1 /* ( */",
                           "t = 'it''s'", "x'00' = b", "t ->> '$.a' = 1", "a --\n < 2"}) {
    EXPECT_EQ(reason_not_to_enclose(good), "") << good;
  }
  for (const char* bad :
       {"",          "  ",      "-- nothing", "1)/*",  "1) OR (1", "1)--", "(1",        "1))",
        "1;",        "1; DROP", "t = '",      "\"a",   "[a",       "`a",   "1 /* open", "1 /*/",
        "t = 'it''", "?",       "?1",         "$a(')", ":a",       "@a",   "#1"}) {
    EXPECT_NE(reason_not_to_enclose(bad), "") << bad;
  }
}

}  // namespace
}  // namespace misalign::schema
