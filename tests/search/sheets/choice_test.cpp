// A spread of candidates against every other choice, and against near twins.
#include "search/sheets/choice.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <random>
#include <set>

#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "search/sheets/farthest_first.hpp"

namespace misalign::search {
namespace {

double nearest(const Eigen::MatrixXd& points, const std::vector<int>& taken) {
  double least = std::numeric_limits<double>::infinity();
  for (const int a : taken) {
    for (const int b : taken) {
      if (a < b) least = std::min(least, (points.col(a) - points.col(b)).norm());
    }
  }
  return least;
}

// Gonzalez' bound, against the best of every set of four.
TEST(FarthestFirst, IsAtLeastHalfAsFarApartAsPossible) {
  std::mt19937 words(1985);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::MatrixXd points =
        Eigen::MatrixXd::NullaryExpr(2, 12, [&] { return coordinate(words); });
    const std::vector<int> taken = farthest_first(points, 4);
    ASSERT_EQ(taken.size(), 4u);
    EXPECT_EQ(taken[0], 0) << "the best one is among them";
    double best = 0;
    for (int set = 0; set < 1 << 12; ++set) {
      if (__builtin_popcount(static_cast<unsigned>(set)) != 4) continue;
      std::vector<int> others;
      for (int k = 0; k < 12; ++k) {
        if (set >> k & 1) others.push_back(k);
      }
      best = std::max(best, nearest(points, others));
    }
    EXPECT_GE(nearest(points, taken), best / 2 - 1e-12);
  }
}

TEST(FarthestFirst, TakesEachOnceEvenAmongEquals) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, 5);
  EXPECT_EQ(farthest_first(points, 9), (std::vector<int>{0, 1, 2, 3, 4}));
}

// Candidates without a catalogue: draw and a column of every kind, and the functions of deploying,
// which count what they are asked for.
class CostlyChoice : public testing::Test {
 protected:
  static constexpr int kRows = 60;

  CostlyChoice() {
    database_.exec(
        "CREATE TABLE candidate AS WITH RECURSIVE n (k) AS (VALUES (0) UNION ALL SELECT k + 1 FROM "
        "n "
        "WHERE k < 59) SELECT k AS draw, k * 0.01 AS stroke_max, 0 AS goes_back, 150 + k % 7 AS "
        "deploys_from_deg, 1 AS miscut_margin_mm, 1 AS slope_min_mm_per_deg FROM n; "
        "CREATE TABLE certificate AS SELECT draw, 100 + draw AS certified_deg FROM candidate; "
        "CREATE VIEW candidates AS SELECT *, (SELECT certified_deg FROM certificate WHERE "
        "certificate.draw = candidate.draw) AS certified_deg FROM candidate");
    for (const std::string_view name : {"deploy_time_s", "critical_friction_n_mm_per_mm"}) {
      EXPECT_TRUE(schema::study_column(name));
      for (const int arguments : {1, 2}) {
        sqlite3_create_function_v2(database_.getHandle(), std::string(name).c_str(), arguments,
                                   SQLITE_UTF8 | SQLITE_DETERMINISTIC, &asked_, answer, nullptr,
                                   nullptr, nullptr);
      }
    }
  }

  // 0, 0.1, ..., 0.4, null.
  static void answer(sqlite3_context* context, int, sqlite3_value** values) {
    const int draw = sqlite3_value_int(values[0]);
    static_cast<std::multiset<int>*>(sqlite3_user_data(context))->insert(draw);
    if (draw % 6 < 5) sqlite3_result_double(context, 0.1 * (draw % 6));
  }

  std::vector<std::uint64_t> draws_of(const std::string& sql) {
    std::vector<std::uint64_t> draws;
    schema::read_query(database_, sql, [&](const SQLite::Statement& row) {
      draws.push_back(static_cast<std::uint64_t>(row.getColumn(0).getInt64()));
    });
    return draws;
  }

  SQLite::Database database_{":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE};
  std::multiset<int> asked_;
};

// Whatever is typed in which order: the same draws, and none is asked about twice or where another
// term does not hold.
TEST_F(CostlyChoice, IsAskedOnlyWhereAllElseHolds) {
  const struct {
    std::string where;
    std::size_t most;
  } kCases[] = {
      {"deploy_time_s(draw) < 0.3 AND stroke_max < 0.125", 13},
      {"stroke_max < 0.125 AND deploy_time_s(draw) < 0.3", 13},
      {"(deploy_time_s(draw) < 0.3 AND stroke_max < 0.125)", 13},
      {"deploy_time_s(draw) < 0.3 and certified_deg < 113", 13},
      {"Deploy_Time_S (draw, 40) IS NULL AND certified_deg < 113 AND stroke_max BETWEEN 0.05 AND 9",
       8},
      {"deploy_time_s(draw) BETWEEN 0.1 AND 0.2 AND draw BETWEEN 3 AND 20 AND NOT draw = 5", 17},
      {"CASE WHEN deploy_time_s(draw) < 0.3 AND draw > 2 THEN 1 ELSE 0 END AND draw < 9 -- few", 9},
      {"coalesce(deploy_time_s(draw), critical_friction_n_mm_per_mm(draw + 1)) < 0.2 AND draw < 9",
       18},
      {"deploy_time_s(draw) < 0.3 /* AND */ AND draw IN (SELECT draw FROM certificate WHERE draw < "
       "4 "
       "AND 'deploy_time_s(' != '')",
       4},
      {"deploy_time_s(draw) < 0.3 OR stroke_max < 0.1 AND draw > 3", 60},
      {"NOT (deploy_time_s(draw) < 0.3 OR stroke_max > 0.1)", 60},
      {"(SELECT end FROM (SELECT 1 AS end)) = 1 AND deploy_time_s(draw) < 0.3 AND draw < 9", 9},
  };
  for (const auto& [where, most] : kCases) {
    SCOPED_TRACE(where);
    Choice choice;
    choice.where = where;
    const auto plain =
        draws_of("SELECT draw FROM candidates WHERE (" + where + "\n) ORDER BY draw");
    ASSERT_FALSE(plain.empty());
    asked_.clear();
    EXPECT_EQ(chosen_draws(database_, choice), plain);
    EXPECT_LE(asked_.size(), most);
    // As a query of somebody's own, where the terms that are no subqueries come first.
    const std::string sql = "SELECT draw FROM candidates WHERE " + where + "\nORDER BY draw";
    asked_.clear();
    EXPECT_EQ(draws_of(schema::costly_in_subqueries(sql)), plain);
    if (where.find("certif") == std::string::npos) {
      EXPECT_LE(asked_.size(), most);
    }
  }
}

// Nothing but conditions changes: columns keep their names, groups and orders their meaning.
TEST_F(CostlyChoice, LeavesTheRestOfAQueryAlone) {
  for (const std::string sql :
       {"SELECT deploy_time_s(draw), max(deploy_time_s( draw )) FROM candidates GROUP BY "
        "deploy_time_s(draw) HAVING count(*) > 2 ORDER BY deploy_time_s(max(draw)) LIMIT 3",
        "SELECT count(*) FILTER (WHERE deploy_time_s(draw) > 0.1) FROM candidates",
        "SELECT 'WHERE deploy_time_s(draw)' FROM candidates ORDER BY deploy_time_s(draw)",
        "SELECT (SELECT deploy_time_s(1 WHERE"}) {
    EXPECT_EQ(schema::costly_in_subqueries(sql), sql);
  }
  for (const std::string sql :
       {"SELECT deploy_time_s(draw) FROM candidates WHERE deploy_time_s(draw) > 0.1",
        "SELECT a.draw FROM candidates a JOIN candidates b ON deploy_time_s(a.draw) > 0.3 AND "
        "b.draw = a.draw WHERE a.draw IN (SELECT draw FROM candidates WHERE deploy_time_s(draw) > "
        "0.2 "
        "AND draw < 30)"}) {
    const std::string other = schema::costly_in_subqueries(sql);
    EXPECT_NE(other, sql);
    const auto table = [&](const std::string& text) {
      return schema::query_table(database_, text, schema::TableStyle::csv);
    };
    EXPECT_EQ(table(other), table(sql)) << other;
  }
}

// What is no column: which one may be meant.
TEST_F(CostlyChoice, SaysWhichColumnMayBeMeant) {
  const auto said = [&](const Choice& choice) -> std::string {
    try {
      chosen_draws(database_, choice);
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), schema::Cause::bad_request);
      return error.what();
    }
    return "";
  };
  for (const auto& [typed, meant] :
       std::vector<std::pair<std::string, std::string>>{{"deploys_from", "deploys_from_deg"},
                                                        {"stroke_mx", "stroke_max"},
                                                        {"strok", "stroke_max"},
                                                        {"thicknes_mm", "thickness_mm"}}) {
    Choice where, by;
    where.where = typed + " > 145";
    by.best = 1;
    by.by = typed;
    for (const Choice& choice : {where, by}) {
      EXPECT_NE(said(choice).find("did you mean " + meant + "?"), std::string::npos)
          << said(choice);
    }
  }
  Choice choice;
  choice.where = "nothing_like_it > 145";
  EXPECT_EQ(said(choice).find("did you mean"), std::string::npos) << said(choice);
}

}  // namespace
}  // namespace misalign::search
