// Reading a catalogue: whoever reads cannot write, and tables come in three styles.
#include "schema/catalogue/named_queries.hpp"
#include "tests/older_catalogues.hpp"
#include "tests/schema/catalogue_fixture.hpp"

namespace misalign::schema {
namespace {

TEST_F(CatalogueTest, ReadersCannotWrite) {
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    catalogue.commit({unit(0, 4096)});
  }
  const CatalogueState before = state();
  const auto database = open_for_reading(path());
  const std::string elsewhere = path("elsewhere.db");
  const std::string kWrites[] = {
      "INSERT INTO screened VALUES ('x', 1, 1)",
      "UPDATE campaign SET goal_end = 1",
      "DELETE FROM candidate",
      "DROP TABLE candidate",
      "CREATE TABLE t (x)",
      "CREATE TEMP TABLE t (x)",
      "ATTACH '" + elsewhere + "' AS other",
      "VACUUM INTO '" + elsewhere + "'",
      "PRAGMA user_version = 9",
      "PRAGMA application_id = 9",
      "PRAGMA writable_schema = ON",
      "PRAGMA journal_mode = DELETE",
      "PRAGMA query_only = OFF",
      "SELECT load_extension('x')",
  };
  for (const std::string& sql : kWrites) {
    EXPECT_THROW(
        {
          SQLite::Statement statement(*database, sql);
          while (statement.executeStep()) {
          }
        },
        SQLite::Exception)
        << sql;
    EXPECT_EQ(refusal([&] { query_table(*database, sql, TableStyle::json); }).cause,
              Cause::bad_request)
        << sql;
  }
  EXPECT_FALSE(std::filesystem::exists(elsewhere));
  EXPECT_EQ(state().digest, before.digest);
  EXPECT_EQ(state().goal_end, before.goal_end);
}

TEST_F(CatalogueTest, QueriesThatAreNoneAreRefused) {
  open();
  const auto database = open_for_reading(path());
  for (const char* sql :
       {"", "   ", "-- nothing", ";", "SELEKT 1", "SELECT * FROM nowhere", "SELECT 1; SELECT 2",
        "SELECT 1; nonsense", "SELECT 1; DROP TABLE unit", "BEGIN", "SELECT abs('x', 1)"}) {
    for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
      const Refusal r = refusal([&] { query_table(*database, sql, style); });
      EXPECT_EQ(r.cause, Cause::bad_request) << sql;
      EXPECT_NE(r.sentence.find(named_query_list()), std::string::npos) << r.sentence;
    }
  }
  for (const char* sql : {"SELECT 1 AS x", "SELECT 1 AS x;", " SELECT 1 AS x ; -- done\n"}) {
    EXPECT_EQ(query_table(*database, sql, TableStyle::csv), "x\n1\n") << sql;
  }
}

TEST_F(CatalogueTest, NamedQueriesRunOnAnyCatalogue) {
  open("empty.db");
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 8192, {}});
    catalogue.commit({unit(0, 8192)});
    catalogue.keep({{5, 0.05, 100, 90, 0}}, "build");
  }
  SQLite::Database(path(), SQLite::OPEN_READWRITE)
      .exec(
          "INSERT INTO sheet VALUES (5, zeroblob(16));"
          "INSERT INTO ascent VALUES (5, 1, 2, 3, 4, 'most_steps', NULL);"
          "UPDATE candidate SET energy_friction_n_mm_per_mm = 1");
  int queries = 0;
  for (const CarriedFile& file : carried_files()) {
    const std::filesystem::path query = file.path;
    if (query.parent_path() != "schema/queries") continue;
    ++queries;
    EXPECT_EQ(named_query(query.stem()), file.text);
    EXPECT_NE(named_query_list().find(query.stem()), std::string::npos);
    const auto filled = open_for_reading(path()), empty = open_for_reading(path("empty.db"));
    for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
      EXPECT_EQ(refusal([&] { query_table(*empty, file.text, style); }).sentence, "") << query;
    }
    EXPECT_FALSE(Json::parse(query_table(*filled, file.text, TableStyle::json)).empty()) << query;
  }
  EXPECT_GE(queries, 5);
  EXPECT_EQ(named_query("no such query"), "");
  EXPECT_EQ(named_query("../catalogue"), "");
}

std::vector<std::string> cookbook() {
  std::ifstream in(std::string(MISALIGN_SOURCE_DIR) + "/schema/queries/README.md");
  const std::string text{std::istreambuf_iterator<char>(in), {}}, open = "```sql\n";
  std::vector<std::string> queries;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    queries.push_back(text.substr(at, text.find("```", at) - at));
  }
  return queries;
}

// Whoever asks an older catalogue as the cookbook says is answered; its rows stand for 1024 draws.
TEST_F(CatalogueTest, OlderCataloguesAnswerTheCookbook) {
  EXPECT_EQ(cookbook().size(), 10u);
  for (const OlderCatalogue& fixture : kOlderCatalogues) {
    const std::string old = fixture.path();
    const auto database = open_for_reading(old);
    const auto rows = [&](const std::string& sql) {
      Json found;
      const Refusal r =
          refusal([&] { found = Json::parse(query_table(*database, sql, TableStyle::json)); });
      EXPECT_EQ(r.sentence, "") << old;
      return found;
    };
    for (const std::string& query : cookbook()) rows(query);
    const int sampled =
        SQLite::Database(old).execAndGet("SELECT count(*) FROM fault_sample").getInt();
    EXPECT_EQ(rows("SELECT coalesce(sum(sampled), 0) AS rows, coalesce(sum(draws), 0) AS draws "
                   "FROM faults"),
              Json::array({{{"rows", sampled}, {"draws", 1024 * sampled}}}));
    for (const Json& row : rows(named_query("rejections"))) {
      EXPECT_EQ(row.at("draws"), 1024 * row.at("sampled").get<int>()) << row;
    }
  }
}

// A table of a million candidates is not read for the best twenty.
TEST_F(CatalogueTest, SortedQueriesHaveIndexes) {
  open();
  SQLite::Database database(path());
  for (const char* name : {"best", "simplest", "smooth", "stroke", "strongest", "tolerant"}) {
    SQLite::Statement steps(database, "EXPLAIN QUERY PLAN " + named_query(name));
    std::string plan;
    while (steps.executeStep()) {
      const bool of_the_rows = steps.getColumn(1).getInt() == 0;  // not of a column's subquery
      if (of_the_rows) plan += steps.getColumn(3).getString() + "; ";
    }
    EXPECT_NE(plan.find("USING INDEX candidate_" + std::string(name)), std::string::npos) << plan;
    EXPECT_EQ(plan.find("B-TREE"), std::string::npos) << plan;
  }
}

// The order is stated once: whoever asks for the best gets it, those that go back last.
TEST_F(CatalogueTest, TheBestDoNotGoBack) {
  UnitRecord record = unit(0, 4096);
  std::mt19937 random(14);
  for (Candidate& some : record.candidates) {
    const auto pick = [&](unsigned of) { return static_cast<double>(random() % of); };
    if (pick(4) > 0)
      some.metrics.slope_between_min_mm_per_deg = pick(3) - 1;
    else
      some.metrics.slope_between_min_mm_per_deg = {};
    if (pick(4) > 0) some.metrics.miscut_margin_mm = pick(3);
    some.metrics.slope_min_mm_per_deg = pick(2);
  }
  {
    Catalogue catalogue = open();
    catalogue.begin_run(kRun, {{0, kEndOfDraws}, 4096, {}});
    catalogue.commit({record});
  }
  // The same said in C++.
  const auto place = [](const Candidate& c) {
    const solver::Metrics& m = c.metrics;
    constexpr double kNone = -1;  // after whatever is known
    return std::tuple(m.slope_between_min_mm_per_deg.value_or(0) < 0, -m.deploys_from_deg,
                      -m.miscut_margin_mm.value_or(kNone), -m.slope_min_mm_per_deg.value_or(kNone),
                      c.draw);
  };
  std::sort(record.candidates.begin(), record.candidates.end(),
            [&](const Candidate& a, const Candidate& b) { return place(a) < place(b); });
  const auto draws_of_query = [&](const std::string& sql) {
    std::vector<std::uint64_t> draws;
    for (const Json& row :
         Json::parse(query_table(*open_for_reading(path()), sql, TableStyle::json))) {
      draws.push_back(row.at("draw").get<std::uint64_t>());
    }
    return draws;
  };
  const std::vector<std::uint64_t> all = record.accepted_draws();
  EXPECT_EQ(draws_of_query("SELECT draw FROM candidates " + best_order()), all);
  EXPECT_EQ(draws_of_query(named_query("best")),
            std::vector<std::uint64_t>(all.begin(), all.begin() + 20));
}

TEST_F(CatalogueTest, TablesInThreeStyles) {
  open();
  const auto database = open_for_reading(path());
  const std::string sql =
      "SELECT 'a,b' AS \"x,y\", 'say \"hi\"' AS quote, 'two' || char(10) || 'lines' AS line, "
      "char(13) AS cr, 0.1 AS real, NULL AS none, -7 AS whole, ' plain' AS plain";
  // RFC 4180, with \n between records.
  EXPECT_EQ(query_table(*database, sql, TableStyle::csv),
            "\"x,y\",quote,line,cr,real,none,whole,plain\n"
            "\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\",\"\r\",0.1,,-7, plain\n");
  const Json expected = {{{"x,y", "a,b"},
                          {"quote", "say \"hi\""},
                          {"line", "two\nlines"},
                          {"cr", "\r"},
                          {"real", 0.1},
                          {"none", nullptr},
                          {"whole", -7},
                          {"plain", " plain"}}};
  EXPECT_EQ(Json::parse(query_table(*database, sql, TableStyle::json)), expected);
  EXPECT_EQ(
      query_table(*database, "SELECT 'b' AS name, 5 AS n UNION ALL SELECT 'long', 10 ORDER BY n",
                  TableStyle::aligned),
      "name   n\n"
      "b      5\n"
      "long  10\n");
  EXPECT_EQ(query_table(*database, "SELECT 1 AS x WHERE 0", TableStyle::csv), "x\n");
  EXPECT_EQ(query_table(*database, "SELECT 1 AS x WHERE 0", TableStyle::json), "[]\n");
  // CSV and JSON keep every bit of a real.
  const double third = 1.0 / 3;
  EXPECT_EQ(std::stod(query_table(*database, "SELECT 1.0 / 3 AS x", TableStyle::csv).substr(2)),
            third);
}

// Two columns of one name are two keys in JSON, which no column of the query has already.
TEST_F(CatalogueTest, ColumnsOfOneNameStayApart) {
  open();
  const auto database = open_for_reading(path());
  const auto first = [&](const std::string& sql) {
    return Json::parse(query_table(*database, sql, TableStyle::json))[0];
  };
  EXPECT_EQ(first("SELECT 1 AS a, 2 AS a, 3 AS a"), (Json{{"a", 1}, {"a_2", 2}, {"a_3", 3}}));
  EXPECT_EQ(first("SELECT 1 AS a, 2 AS a, 3 AS a_2"), (Json{{"a", 1}, {"a_3", 2}, {"a_2", 3}}));
  EXPECT_EQ(first("SELECT 1 AS a_2, 2 AS a, 3 AS a"), (Json{{"a_2", 1}, {"a", 2}, {"a_3", 3}}));
  EXPECT_EQ(query_table(*database, "SELECT 1 AS a, 2 AS a", TableStyle::csv), "a,a\n1,2\n");
}

TEST_F(CatalogueTest, CellsStayWithinTheirRowsAndColumns) {
  open();
  const auto database = open_for_reading(path());
  const std::string text =
      query_table(*database,
                  "SELECT 'a' || char(10) || 'b' || char(27) AS x, 1 AS n UNION ALL "
                  "SELECT char(233), 2 ORDER BY n",
                  TableStyle::aligned);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
  const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_EQ(last.size(), text.find('\n') + 2) << text;  // one letter of two bytes, and \n
}

// A million rows, of which an aligned table keeps the first thousand.
TEST_F(CatalogueTest, RowsAreGivenOnAsTheyCome) {
  open();
  const auto database = open_for_reading(path());
  const std::string sql =
      "WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n WHERE k < 300000) SELECT "
      "k, "
      "'a text of some length' AS t FROM n";
  for (const TableStyle style : {TableStyle::aligned, TableStyle::json, TableStyle::csv}) {
    std::size_t longest = 0, bytes = 0, lines = 0;
    std::string last;
    const std::uint64_t rows = write_query(*database, sql, style, [&](const std::string& piece) {
      longest = std::max(longest, piece.size());
      bytes += piece.size();
      lines += static_cast<std::size_t>(std::count(piece.begin(), piece.end(), '\n'));
      last = piece;
      return true;
    });
    EXPECT_EQ(rows, 300000u);
    EXPECT_LT(longest, 200u);
    EXPECT_GT(bytes, 300000u * 25);
    if (style == TableStyle::aligned) {
      EXPECT_EQ(last, "300000  a text of some length\n");
    }
    if (style != TableStyle::json) {
      EXPECT_EQ(lines, 300001u);
    }
  }
  // Whoever has read enough stops it.
  int pieces = 0;
  const auto enough = [&](const std::string&) { return ++pieces < 10; };
  EXPECT_EQ(write_query(*database, sql, TableStyle::csv, enough), 9u);
  EXPECT_EQ(pieces, 10);
}

// Who asks without an end sees rows all the same, many or few a second, in columns as wide as the
// first ones need; and ends it.
TEST_F(CatalogueTest, AnEndlessTableBegins) {
  open();
  const auto database = open_for_reading(path());
  const std::string sql =
      "WITH RECURSIVE n (k) AS (VALUES (1) UNION ALL SELECT k + 1 FROM n) SELECT k, 'x' AS t FROM "
      "n";
  for (const char* which : {"", " WHERE k % 200000 = 0"}) {
    std::vector<std::string> lines;
    write_query(*database, sql + which, TableStyle::aligned, [&](const std::string& line) {
      lines.push_back(line);
      return lines.size() < 3;
    });
    ASSERT_EQ(lines.size(), 3u) << which;
    const std::size_t width = lines[0].find("  t");
    EXPECT_LE(width, 8u) << lines[0];
    for (const std::string& line : lines) EXPECT_EQ(line.find("  ", width), width) << line;
  }
}

}  // namespace
}  // namespace misalign::schema
