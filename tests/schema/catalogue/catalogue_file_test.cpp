// The catalogue's file: whose it is, who may write it, and of which version it is.
#include <fstream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/ledger_check.hpp"
#include "tests/older_catalogues.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

using CatalogueFile = CatalogueTest;

TEST_F(CatalogueFile, AnotherCampaignIsRefusedAndNamed) {
  open();
  const std::pair<const char*, const char*> kOthers[] = {
      {R"({"seed": 2})", "/seed"},
      {R"({"accept": {"deploys_from_deg": 150}})", "/accept"},
      {R"({"misalignment": {"levels": "uniform"}})", "/misalignment"},
      {R"({"pattern": {"holes": "checkerboard-even"}})", "/pattern"},
  };
  for (const auto& [patch, named] : kOthers) {
    const Campaign other = changed(patch);
    const auto mechanism = mechanism_of(other);
    const Refusal r = refusal([&] { Catalogue(path(), other, mechanism); });
    EXPECT_EQ(r.cause, Cause::foreign) << patch;
    EXPECT_NE(r.sentence.find(named), std::string::npos) << r.sentence;
    EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
  }
  // What is outside the identity makes no other campaign, and the last run's wins.
  const Campaign renamed = changed(R"({"name": "renamed", "stop": {"draws": 5}})");
  {
    Catalogue catalogue(path(), renamed, mechanism_);
    catalogue.begin_run(kRun, {});
  }
  EXPECT_EQ(state().name, "renamed");
  EXPECT_EQ(identity(read_campaign_of(*open_for_reading(path()), path())), identity(campaign_));
}

TEST_F(CatalogueFile, OtherFilesAreRefusedAndLeftAlone) {
  const auto read_all = [](const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  std::ofstream(path("short")) << "hello\n";
  std::ofstream(path("long")) << std::string(10000, 'x');
  SQLite::Database(path("foreign"), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE mine (x)");
  for (const char* name : {"short", "long", "foreign"}) {
    const std::string before = read_all(path(name));
    EXPECT_EQ(refusal([&] { open(name); }).cause, Cause::bad_input) << name;
    EXPECT_EQ(refusal([&] { open_for_reading(path(name)); }).cause, Cause::bad_input) << name;
    EXPECT_EQ(read_all(path(name)), before) << name;
  }
  std::ofstream(path("empty"));
  for (const char* name : {"absent", "empty", "."}) {
    EXPECT_EQ(refusal([&] { open_for_reading(path(name)); }).cause, Cause::bad_input) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(path("absent")));
  EXPECT_EQ(refusal([&] { open("empty"); }).cause,
            std::nullopt);  // as a killed search may leave it
  EXPECT_EQ(refusal([&] { open("no/folder.db"); }).cause, Cause::failure);
}

TEST_F(CatalogueFile, NewerSchemaIsRefused) {
  open();
  SQLite::Database(path(), SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = " + std::to_string(kSchemaVersion + 1));
  for (const Refusal& r : {refusal([&] { open(); }), refusal([&] { open_for_reading(path()); })}) {
    EXPECT_EQ(r.cause, Cause::foreign);
    EXPECT_NE(r.sentence.find("schema version"), std::string::npos) << r.sentence;
  }
}

// It says which program reads it, and stays as it is.
TEST_F(CatalogueFile, SchemasBeforeTheFirstReleaseAreRefused) {
  open();
  SQLite::Database(path(), SQLite::OPEN_READWRITE)
      .exec("PRAGMA user_version = " + std::to_string(kOldestSchemaVersion - 1));
  const std::string before = bytes_of(path());
  for (const Refusal& r : {refusal([&] { open(); }), refusal([&] { open_for_reading(path()); })}) {
    EXPECT_EQ(r.cause, Cause::foreign);
    EXPECT_NE(r.sentence.find("misalign 1.0.0"), std::string::npos) << r.sentence;
  }
  EXPECT_EQ(bytes_of(path()), before);
}

TEST_F(CatalogueFile, VersionAndKindAreThoseOfTheHeader) {
  open();
  SQLite::Database database(path());
  EXPECT_EQ(database.execAndGet("PRAGMA user_version").getInt(), kSchemaVersion);
  EXPECT_EQ(database.execAndGet("PRAGMA application_id").getInt(), kApplicationId);
}

TEST_F(CatalogueFile, OneWriterAtATime) {
  {
    Catalogue first = open();
    first.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    const Refusal r = refusal([&] { open(); });
    EXPECT_EQ(r.cause, Cause::in_use);
    EXPECT_EQ(r.sentence.find(path()), 0u) << r.sentence;
    first.commit({unit(0, 4096)});    // the attempt did it no harm
    EXPECT_EQ(state().draws, 4096u);  // and readers never wait
  }
  EXPECT_EQ(refusal([&] { open(); }).cause, std::nullopt);
}

// A link to a link to a file that is not there yet: what belongs to the file lies beside it, and
// whoever comes by another way finds it in use.
TEST_F(CatalogueFile, LinksAreFollowedToTheirEnd) {
  namespace fs = std::filesystem;
  fs::create_directories(path("far/away"));
  fs::create_symlink("far/away/real.db", path("middle.db"));
  fs::create_symlink("middle.db", path("one.db"));
  fs::create_symlink(path("middle.db"), path("two.db"));
  const auto names_in = [](const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  };
  const auto links = names_in(path("."));
  {
    Catalogue first = open("one.db");
    first.begin_run(kRun, {{0, kEndOfDraws}, 300, {}});
    EXPECT_EQ(refusal([&] { open("two.db"); }).cause, Cause::in_use);
    first.commit({unit(0, 300)});
    EXPECT_TRUE(fs::exists(path("far/away/real.db-wal")));
    EXPECT_EQ(names_in(path(".")), links);
    EXPECT_EQ(state("two.db").draws, 300u);
  }
  EXPECT_EQ(refusal([&] { open("two.db"); }).cause, std::nullopt);
  // A catalogue that could not be made leaves no file behind, and the links alone.
  fs::create_symlink("far/away/other.db", path("third.db"));
  fs::create_symlink("third.db", path("fourth.db"));
  Campaign broken = campaign_;
  broken.name = std::string(1, '\xff');  // no JSON can hold it
  EXPECT_ANY_THROW(Catalogue(path("fourth.db"), broken, mechanism_));
  EXPECT_TRUE(fs::is_symlink(path("third.db")) && fs::is_symlink(path("fourth.db")));
  EXPECT_EQ(names_in(path("far/away")), std::vector<std::string>{"real.db"});
  // In a circle.
  fs::create_symlink("right.db", path("left.db"));
  fs::create_symlink("left.db", path("right.db"));
  const Refusal circle = refusal([&] { open("left.db"); });
  EXPECT_EQ(circle.cause, Cause::failure);
  EXPECT_NE(circle.sentence.find("link"), std::string::npos) << circle.sentence;
}

// A file of every schema since release 1.0.0: the same rows and digest afterwards, laid out as a
// new one.
TEST_F(CatalogueFile, OlderSchemasAreBroughtUpToDate) {
  const auto rows = [](const std::string& file, const std::string& columns) {
    return query_table(*open_for_reading(file), "SELECT " + columns + " FROM candidate",
                       TableStyle::csv);
  };
  const std::string columns =
      "draw, unit, deploys_from_sample, slope_min_mm_per_deg, displacements_mm, elongation";
  { Catalogue fresh = open("fresh.db"); }
  const auto layout = [&](const std::string& file) {
    SQLite::Database database(file);
    SQLite::Statement statement(
        database,
        "SELECT t.name || '.' || c.name AS part FROM sqlite_schema AS t, pragma_table_info(t.name) "
        "AS c WHERE t.type IN ('table', 'view') UNION SELECT name FROM sqlite_schema ORDER BY 1");
    std::string all;
    while (statement.executeStep()) all += statement.getColumn(0).getString() + " ";
    return all;
  };
  for (const OlderCatalogue& fixture : kOlderCatalogues) {
    const auto& [name, version, first] = fixture;
    const std::string old = fixture.path();
    std::filesystem::copy_file(old, path(name));
    // Whatever has the name of its copy, there is one.
    const std::string copy = path(name) + ".version-" + std::to_string(version);
    std::ofstream(copy) << "somebody's";
    EXPECT_EQ(open_for_reading(old)->execAndGet("PRAGMA user_version").getInt(), version);
    const std::string before = rows(old, columns);
    const CatalogueState state_before = read_state(*open_for_reading(old));
    const Campaign campaign = read_campaign_of(*open_for_reading(old), "fixture");
    const solver::Mechanism mechanism = mechanism_of(campaign);
    { Catalogue catalogue(path(name), campaign, mechanism); }
    const auto database = open_for_reading(path(name));
    EXPECT_EQ(database->execAndGet("PRAGMA user_version").getInt(), kSchemaVersion);
    EXPECT_EQ(rows(path(name), columns), before);
    EXPECT_EQ(state(name).digest, state_before.digest);
    EXPECT_GT(count("candidate", name), 10);
    EXPECT_EQ(layout(path(name)), layout(path("fresh.db")));
    EXPECT_TRUE(check_ledger(*database, campaign).empty());
    // The file as it was is kept, once.
    EXPECT_EQ(rows(copy + "-2", "*"), rows(old, "*"));
    EXPECT_EQ(bytes_of(copy), "somebody's");
    { Catalogue again(path(name), campaign, mechanism); }
    EXPECT_FALSE(std::filesystem::exists(copy + "-3"));
  }
  EXPECT_EQ(count("candidates WHERE bump_deg IS NULL", "catalogue-7-from-1.db"),
            count("candidate", "catalogue-7-from-1.db"));
  EXPECT_EQ(count("undecided", "catalogue-7-from-2.db"), 1);
  // Rows that today's rule would leave out stay, with the weight they had: draw 2^28 + 1024.
  EXPECT_EQ(count("fault_sample WHERE stands_for = 1024", "catalogue-7-from-3.db"), 3);
  EXPECT_EQ(count("fault_sample WHERE draw = 268436480", "catalogue-7-from-3.db"), 1);
}

// An older catalogue goes on by today's rule, in the same file: each unit by that of its run.
TEST_F(CatalogueFile, UnitsKeepTheRuleOfTheirRun) {
  std::filesystem::copy_file(
      std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7-from-3.db", path());
  const Campaign campaign = read_campaign_of(*open_for_reading(path()), path());
  const solver::Mechanism mechanism = mechanism_of(campaign);
  constexpr std::uint64_t k2_28 = 268435456;
  const auto rejects_all = [](std::uint64_t) { return false; };
  {
    Catalogue catalogue(path(), campaign, mechanism);
    catalogue.begin_run({"host", "0", "none", "g++", "-O2", "other", 1}, {}, Builds::mixed);
    catalogue.commit({unit(k2_28 + 2000, k2_28 + 10000, rejects_all)});
    catalogue.end_run("stopped");
  }
  const auto database = open_for_reading(path());
  EXPECT_EQ(draws_of(*database, "fault_sample", {1, kEndOfDraws}),
            (std::vector<std::uint64_t>{k2_28, k2_28 + 1024, k2_28 + 4096, k2_28 + 8192}));
  EXPECT_EQ(count("fault_sample WHERE stands_for = 4096"), 2);
  EXPECT_TRUE(check_ledger(*database, campaign).empty());
  // A row by the wrong rule, of an old unit or a new one, or with the wrong weight, is found.
  const char* const kWrong[] = {
      "DELETE FROM fault_sample WHERE draw = 268436480",
      "INSERT INTO fault_sample SELECT 268435456 + 5120, unit, 7, first_fault, fault_deg, "
      "\"where\", 1024 FROM fault_sample WHERE draw = 268435456 + 4096",
      "UPDATE fault_sample SET stands_for = 2048 WHERE draw = 268435456",
      "UPDATE fault_sample SET stands_for = 1024 WHERE draw = 268435456 + 4096",
      "UPDATE run SET schema_version = 4 WHERE schema_version = 3"};
  for (const char* sql : kWrong) {
    std::filesystem::copy_file(path(), path("wrong.db"),
                               std::filesystem::copy_options::overwrite_existing);
    SQLite::Database(path("wrong.db"), SQLite::OPEN_READWRITE).exec(sql);
    EXPECT_FALSE(check_ledger(*open_for_reading(path("wrong.db")), campaign).empty()) << sql;
  }
}

}  // namespace
}  // namespace misalign::schema
