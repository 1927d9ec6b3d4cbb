// Functions of sheets wherever they can stand: each against the study itself, in every place, and
// by any number of threads.
#include "search/sheets/study_functions.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/costly_terms.hpp"
#include "schema/catalogue/query_text.hpp"
#include "schema/catalogue/result_table.hpp"
#include "schema/catalogue/study_table.hpp"
#include "schema/memory/study_memory.hpp"
#include "schema/report/report.hpp"
#include "search/draws/draw.hpp"
#include "search/sheets/choice.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/sheet_numbers.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/motion/deploy.hpp"
#include "solver/shape/surface_curvature.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

// The catalogue of tests/fixtures, with a design.
class FunctionsOfSheets : public testing::Test {
 protected:
  FunctionsOfSheets() { add_study_functions(*database_, campaign_, ""); }

  static schema::Campaign campaign(SQLite::Database& database) {
    schema::Campaign campaign = schema::read_campaign_of(database, "a fixture");
    campaign.design.from_deg = 90;
    campaign.design.stiffness_n_per_mm = 2;
    campaign.design.friction_n_mm_per_mm = 1e-4;
    return campaign;
  }
  std::vector<double> numbers(const std::string& sql) {
    std::vector<double> all;
    schema::read_query(*database_, sql, [&](const SQLite::Statement& row) {
      all.push_back(row.getColumn(0).isNull() ? -1 : row.getColumn(0).getDouble());
    });
    return all;
  }
  solver::Sheet sheet(std::uint64_t draw) { return model_.sheet(shifts_of_draw(campaign_, draw)); }

  const std::unique_ptr<SQLite::Database> database_ =
      schema::open_for_reading(std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7.db");
  const schema::Campaign campaign_ = campaign(*database_);
  FoldingModel model_{campaign_};
};

// By the fold angles and lengths of its own creases, from a path that is followed: not all of them
// fold as far as the pilot.
TEST_F(FunctionsOfSheets, FilmsLoseWhatTheirCreasesTurn) {
  schema::Design design = campaign_.design;
  design.friction_n_mm_per_mm.reset();
  design.film = solver::FilmHinge{0.05, 4, 2, 0.02};
  const solver::Sheet its = sheet(1);
  double lost = 0, turned_mm = 0;
  for (std::size_t c = 0; c < its.mechanism().creases.size(); ++c) {
    const solver::Crease& crease = its.mechanism().creases[c];
    const double length_mm = (its.point_mm(crease.b) - its.point_mm(crease.a)).norm();
    const double fold_rad =
        std::abs(its.history().fold_angle_deg(89, static_cast<Eigen::Index>(c))) * M_PI / 180;
    lost +=
        M_PI / 4 * 0.02 * design.film->stiffness_n_mm_per_mm() * length_mm * fold_rad * fold_rad;
    turned_mm += length_mm * fold_rad;
  }
  EXPECT_NEAR(hinge_friction_n_mm_per_mm(design, its) * turned_mm / lost, 1, 1e-9);
  EXPECT_EQ(deploy_options(design, its).sheet.joints.friction_n_mm_per_mm,
            hinge_friction_n_mm_per_mm(design, its));
  design.friction_n_mm_per_mm = 0.02;
  EXPECT_EQ(hinge_friction_n_mm_per_mm(design, its), 0.02) << "as it is said";
  EXPECT_EQ(hinge_friction_n_mm_per_mm({}, its), 0);
}

// Each name of the table is found, and nothing else is.
TEST_F(FunctionsOfSheets, AreThoseOfTheTable) {
  std::vector<std::string> found(sheet_number_names().begin(), sheet_number_names().end());
  std::vector<std::string> said = schema::study_functions();
  std::ranges::sort(found);
  std::ranges::sort(said);
  EXPECT_EQ(found, said);
}

TEST_F(FunctionsOfSheets, SayWhatTheStudiesSay) {
  for (const double from_deg : {60.0, 90.0}) {
    const auto from = std::to_string(from_deg);
    const auto of = [&](const char* name, int draw) {
      return numbers(fmt::format("SELECT {}({}, {})", name, draw, from)).front();
    };
    for (const int draw : {3, 28, 40}) {
      const solver::Sheet studied = sheet(static_cast<std::uint64_t>(draw));
      ASSERT_GE(studied.deploys_from_deg(), 30);
      if (studied.deploys_from_deg() < from_deg) continue;
      solver::ReleaseOptions options;
      options.from_deg = from_deg;
      options.sheet.springs().stiffness_n_per_mm = 2;
      options.sheet.joints.friction_n_mm_per_mm = 1e-4;
      const solver::DeploymentStudy study = *solver::deploy(studied, options);
      EXPECT_EQ(of("critical_friction_n_mm_per_mm", draw),
                study.friction.critical_n_mm_per_mm.value_or(-1));
      EXPECT_EQ(of("stall_deg", draw), study.friction.static_stall_deg);
      EXPECT_EQ(of("deploy_time_s", draw), study.deploy_time_s().value_or(-1));
      EXPECT_NEAR(of("energy_n_mm", draw), study.run.rows.front().springs_n_mm, 1e-9);
      const solver::ContactStudy contact = *solver::contact(studied, {{}, from_deg});
      EXPECT_EQ(of("thickness_mm", draw), contact.thickness->thickness_mm);
      EXPECT_EQ(of("first_contact_deg", draw), contact.first ? contact.first->pilot_deg : -1);
      const auto curved = solver::surface_curvature(studied, from_deg);
      EXPECT_EQ(of("curvature_1_per_m", draw), curved ? 1000 * curved->per_mm[0] : -1);
      EXPECT_EQ(of("curvature_2_per_m", draw), curved ? 1000 * curved->per_mm[1] : -1);
      // By its history at the samples, which shares no table with the way.
      const solver::Actuation springs =
          solver::actuate(studied, solver::Actuators{solver::Springs{2}, {}}, from_deg);
      EXPECT_NEAR(of("energy_n_mm", draw),
                  springs.energy_n_mm[static_cast<std::size_t>(springs.from_row)], 1e-6);
    }
  }
}

// NAME, NAME(draw) and NAME(draw, from_deg): in conditions, orders, queries and the report's
// columns.
TEST_F(FunctionsOfSheets, StandWhereverTheyCan) {
  constexpr const char* kSome = "draw IN (SELECT draw FROM candidates ORDER BY draw LIMIT 6)";
  for (const std::string& name : schema::study_functions()) {
    SCOPED_TRACE(name);
    const std::string full = name + "(draw)";
    const auto plain =
        numbers("SELECT " + full + " FROM candidates WHERE " + kSome + " ORDER BY draw");
    ASSERT_EQ(plain.size(), 6u);
    const double middle = plain[2];
    for (const std::string& word : {name, full, name + "(draw, 90)"}) {
      SCOPED_TRACE(word);
      Choice where;
      where.where = std::string(kSome) + " AND coalesce(" + word +
                    ", -1) >= " + fmt::format("{:.17g}", middle);
      const auto expected = std::ranges::count_if(plain, [&](double x) { return x >= middle; });
      EXPECT_EQ(chosen_draws(*database_, where).size(), static_cast<std::size_t>(expected));
      Choice by;
      by.where = kSome;
      by.best = 1;
      by.by = word;
      const auto best = chosen_draws(*database_, by).front();
      EXPECT_EQ(numbers(fmt::format("SELECT {}({})", name, best)).front(), std::ranges::max(plain));
      const std::string query =
          schema::query_text(*database_, "SELECT " + word + ", D FROM candidates WHERE " + kSome +
                                             " AND D > 0 ORDER BY draw")
              .sql;
      look_ahead(*database_, query);
      EXPECT_EQ(numbers(query), plain);
      EXPECT_EQ(numbers("SELECT " + column_sql(*database_, word) + " FROM candidates WHERE " +
                        kSome + " ORDER BY draw"),
                plain);
    }
    const schema::Json page =
        schema::candidates_json(*database_, 3, {schema::study_column(name)->name});
    EXPECT_EQ(page["columns"][name].size(), 3u);
  }
}

// Ahead of a query with many sheets, and behind its LIMIT: the same numbers, in any order.
TEST_F(FunctionsOfSheets, AreTheSameAheadOfAQuery) {
  const std::string sql =
      "SELECT energy_n_mm(draw, 30 + draw % 7) FROM candidates WHERE "
      "critical_friction_n_mm_per_mm(draw) > "
      "0 ORDER BY draw DESC LIMIT 20";
  const auto database =
      schema::open_for_reading(std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7.db");
  add_study_functions(*database, campaign_, "");
  std::vector<double> alone;
  schema::read_query(*database, sql, [&](const SQLite::Statement& row) {
    alone.push_back(row.getColumn(0).getDouble());
  });
  look_ahead(*database_, sql);
  EXPECT_EQ(numbers(sql), alone);
  EXPECT_EQ(alone.size(), 20u);
}

// Looked at ahead, no row passes such a condition, or all rows are one.
TEST_F(FunctionsOfSheets, EndAheadOfAQueryThatDoesNot) {
  constexpr const char* kForEver =
      "WITH RECURSIVE n (k) AS (VALUES (3) UNION ALL SELECT k + 1 FROM n) ";
  const auto first =
      numbers(std::string("SELECT energy_n_mm(draw) FROM candidates WHERE draw = 3"));
  const std::string where = kForEver + std::string(
                                           "SELECT energy_n_mm(k) FROM n WHERE "
                                           "energy_n_mm(k) IS NOT NULL LIMIT 1");
  look_ahead(*database_, where);
  EXPECT_EQ(numbers(where), first);
  look_ahead(*database_, kForEver + std::string("SELECT max(energy_n_mm(k)) FROM n LIMIT 1"));
}

// A remembered number shows by a change in its file: nothing computes it again.
TEST_F(FunctionsOfSheets, AreRememberedBesideTheCatalogue) {
  const Folder folder("remembered");
  const std::string path = folder.file("a.db");
  std::filesystem::copy_file(std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7.db",
                             path);
  const auto energy = [&](const schema::Campaign& campaign) {
    const auto database = schema::open_for_reading(path);
    add_study_functions(*database, campaign, path);
    constexpr const char* kSql = "SELECT energy_n_mm(draw) FROM candidates WHERE draw = 3";
    look_ahead(*database, kSql);
    double n_mm = 0;
    schema::read_query(*database, kSql,
                       [&](const SQLite::Statement& row) { n_mm = row.getColumn(0).getDouble(); });
    return n_mm;
  };
  const double computed_n_mm = energy(campaign_);
  EXPECT_EQ(computed_n_mm, numbers("SELECT energy_n_mm(3)").front());
  SQLite::Database file(schema::StudyMemory::path_beside(path), SQLite::OPEN_READWRITE);
  EXPECT_EQ(file.exec("UPDATE number SET value = 2 * value"), 1);
  EXPECT_EQ(energy(campaign_), 2 * computed_n_mm);
  schema::Campaign stiffer = campaign_;
  stiffer.design.stiffness_n_per_mm = 6;
  EXPECT_NEAR(energy(stiffer), 3 * computed_n_mm, 1e-9 * computed_n_mm);
  file.exec("UPDATE number SET version = version - 1");
  EXPECT_EQ(energy(campaign_), computed_n_mm);
}

// Double quotes are of names alone: a text there would be larger than any number.
TEST_F(FunctionsOfSheets, AQuotedNameIsNoText) {
  Choice choice;
  choice.where = R"("D" > 999)";
  EXPECT_THROW(chosen_draws(*database_, choice), schema::UserError);
  choice.where = R"("deploys_from_deg" > 0)";
  EXPECT_FALSE(chosen_draws(*database_, choice).empty());
}

TEST_F(FunctionsOfSheets, NearNamesAreNamed) {
  const auto said = [&](const Choice& choice) -> std::string {
    try {
      chosen_draws(*database_, choice);
    } catch (const schema::UserError& error) {
      EXPECT_EQ(error.cause(), schema::Cause::bad_request);
      return error.what();
    }
    return "";
  };
  for (const std::string& name : schema::study_functions()) {
    std::string misspelt = name;
    misspelt.erase(2, 1);
    Choice where, by;
    where.where = misspelt + "(draw) > 0.1";
    by.best = 1;
    by.by = misspelt;
    for (const Choice& choice : {where, by}) {
      EXPECT_NE(said(choice).find("did you mean " + name + "?"), std::string::npos) << said(choice);
    }
  }
  Choice by;
  by.best = 1;
  for (const char* bad : {"thickness_mm(draw", "thickness_mm(draw, x)", "thickness_mm(1)",
                          "thickness_mm(draw); DROP", "stroke_max, draw"}) {
    by.by = bad;
    EXPECT_NE(said(by), "") << bad;
  }
}

TEST(InFull, IsWhatPeopleMean) {
  for (const auto& [typed, meant] : std::vector<std::pair<std::string, std::string>>{
           {"D > 150", "deploys_from_deg > 150"},
           {"c.D > 150 AND thickness_mm > 1", "c.D > 150 AND thickness_mm(draw) > 1"},
           {"thickness_mm (draw, 140) > D", "thickness_mm (draw, 140) > deploys_from_deg"},
           {"'D' = \"D\" OR d > 1", "'D' = \"D\" OR d > 1"},
           {"SELECT Stall_Deg AS D FROM n", "SELECT stall_deg(draw) AS D FROM n"}}) {
    EXPECT_EQ(schema::in_full(typed), meant);
  }
}

}  // namespace
}  // namespace misalign::search
