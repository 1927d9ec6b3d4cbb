// Catalogues of one campaign, made in pieces that overlap: joined they are what one run makes.
#include "search/checks/merge.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/candidate_row.hpp"
#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/result_table.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/folder.hpp"

namespace misalign::search {
namespace {

using schema::DrawRange;
using schema::Json;

// Short paths that most draws survive.
schema::Campaign quick_campaign() {
  return schema::read_campaign(
      Json::parse(R"({"name": "quick", "pattern": {"family": "miura", "rows": 4, "columns": 4},
                      "path": {"end_deg": 30}, "accept": {"deploys_from_deg": 20}})"),
      "test");
}

class MergeTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }

  std::string make(const std::string& name, const std::vector<DrawRange>& units,
                   const DrawRange& goal = {0, 3000}) {
    schema::Catalogue catalogue(path(name), evaluator_.campaign(), evaluator_.mechanism());
    catalogue.begin_run(run_, {goal, {}, {}});
    for (const DrawRange& unit : units) catalogue.commit({work_off(evaluator_, unit)});
    catalogue.end_run("stopped");
    return path(name);
  }

  MergeReport join(const std::vector<std::string>& inputs) {
    std::filesystem::remove(path("all.db"));
    return merge({path("all.db"), inputs, run_, schema::Builds::same});
  }
  schema::CatalogueState state(const std::string& name) {
    return schema::read_state(*schema::open_for_reading(path(name)));
  }
  void change(const std::string& name, const std::string& sql) {
    SQLite::Database(path(name), SQLite::OPEN_READWRITE).exec(sql);
  }
  bool something_written() {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      if (entry.path().filename().string().starts_with("all.db")) return true;
    }
    return false;
  }
  /// A sentence about this file, naming this column; and no output.
  testing::AssertionResult disagrees(const MergeReport& report, const std::string& column) {
    if (something_written()) {
      return testing::AssertionFailure() << "something was written";
    }
    std::string all;
    for (const schema::Finding& finding : report.findings) {
      all += finding.sentence + "\n";
      if (finding.details.at("column") == column) return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "found only: " << all;
  }

  const schema::RunInfo run_{"host", "0", "none", "g++", "-O2", "golden", 1};
  DrawEvaluator evaluator_{quick_campaign()};
  const Folder folder_{"merge"};
};

TEST_F(MergeTest, PiecesAreTheWholeSlow) {
  make("whole.db", {{0, 3000}});
  const std::string whole = state("whole.db").digest;
  const auto a = make("a.db", {{0, 700}, {700, 1500}}, {0, 1500});
  const auto b = make("b.db", {{1500, 3000}}, {1500, 3000});
  MergeReport report = join({a, b});
  EXPECT_TRUE(report.findings.empty());
  EXPECT_EQ(report.units, 3u);
  EXPECT_EQ(report.compared + report.recomputed, 0u);
  const schema::CatalogueState merged = state("all.db");
  EXPECT_EQ(merged.digest, whole);
  EXPECT_TRUE(merged.gaps.empty());
  EXPECT_EQ(merged.goal.range, (DrawRange{0, 3000}));
  // Every row, but for when and by whom.
  const auto rows = [&](const std::string& name) {
    const auto database = schema::open_for_reading(path(name));
    std::vector<Json> all;
    for (const auto draw : schema::draws_of(*database, "candidate", {0, 3000})) {
      all.push_back(schema::read_candidate(*database, draw));
      all.back().erase("unit");
    }
    return all;
  };
  EXPECT_EQ(rows("all.db"), rows("whole.db"));
  // In any order, and joined with itself.
  EXPECT_TRUE(join({b, a, b, a}).findings.empty());
  EXPECT_EQ(state("all.db").digest, whole);
}

TEST_F(MergeTest, OverlapsAreComparedAndPartsMadeAgainSlow) {
  make("whole.db", {{0, 3000}});
  const auto a = make("a.db", {{0, 1000}, {1000, 1800}});
  const auto b = make("b.db", {{0, 1000}, {1600, 2500}, {2600, 3000}});
  const auto c = make("c.db", {{2400, 2650}});
  const MergeReport report = join({a, b, c});
  for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_EQ(report.units, 3u);                // 0, 1600 and 2600
  EXPECT_EQ(report.recomputed, 600u + 100u);  // 1000 to 1600, and 2500 to 2600
  EXPECT_EQ(report.compared, 1000u + 800u + 250u);
  EXPECT_EQ(state("all.db").digest, state("whole.db").digest);
}

TEST_F(MergeTest, DisagreementsAreNamedAndNothingIsWrittenSlow) {
  make("a.db", {{0, 1024}});
  const auto first = [&] {
    const auto database = schema::open_for_reading(path("a.db"));
    return schema::draws_of(*database, "candidate", {0, 1024}).front();
  };
  const std::string draw = std::to_string(first());
  const std::pair<const char*, std::string> kChanges[] = {
      {"displacements_mm",
       "UPDATE candidate SET displacements_mm = '{\"A10\":[0.1,0.0]}' WHERE draw = " + draw},
      {"stroke_max", "UPDATE candidate SET stroke_max = stroke_max + 1e-10 WHERE draw = " + draw},
      {"shifted_vertices", "UPDATE candidate SET shifted_vertices = 1 WHERE draw = " + draw},
      {"bump_deg", "UPDATE candidate SET bump_deg = 7 WHERE draw = " + draw},
      {"fault_sample", "UPDATE fault_sample SET first_fault = 'over_folded' WHERE draw = 0"},
  };
  for (const auto& [column, sql] : kChanges) {
    std::filesystem::remove(path("b.db"));
    make("b.db", {{0, 1024}});
    change("b.db", sql);
    EXPECT_TRUE(disagrees(join({path("a.db"), path("b.db")}), column)) << column;
    EXPECT_TRUE(disagrees(join({path("b.db"), path("a.db")}), column)) << column;
  }
  // One older name may be either of two.
  std::filesystem::remove(path("b.db"));
  make("b.db", {{0, 1024}});
  change("a.db", "UPDATE fault_sample SET first_fault = 'reverses_between_samples'");
  change("b.db", "UPDATE fault_sample SET first_fault = 'bump_between_samples'");
  EXPECT_TRUE(join({path("a.db"), path("b.db")}).findings.empty());
  EXPECT_TRUE(join({path("b.db"), path("a.db")}).findings.empty());
  std::filesystem::remove(path("a.db"));
  make("a.db", {{0, 1024}});
  // Within what is known of its errors a metric may differ.
  std::filesystem::remove(path("b.db"));
  make("b.db", {{0, 1024}});
  change("b.db", "UPDATE candidate SET stroke_max = stroke_max + 1e-12");
  EXPECT_TRUE(join({path("a.db"), path("b.db")}).findings.empty());
  // What contradicts itself is no input.
  change("b.db", "DELETE FROM candidate WHERE draw = " + draw);
  EXPECT_TRUE(disagrees(join({path("b.db")}), "accepted"));
}

TEST_F(MergeTest, VerdictsThatDifferAreNamedSlow) {
  make("a.db", {{0, 500}});
  {
    schema::UnitRecord unit = work_off(evaluator_, {0, 500});
    unit.candidates.pop_back();
    --unit.accepted;
    ++unit.rejected;
    ++unit.screened[{static_cast<int>(solver::Fault::not_monotone), 8}];
    schema::Catalogue catalogue(path("b.db"), evaluator_.campaign(), evaluator_.mechanism());
    catalogue.begin_run(run_, {{0, 3000}, {}, {}});
    catalogue.commit({unit});
    catalogue.end_run("stopped");
  }
  EXPECT_TRUE(disagrees(join({path("a.db"), path("b.db")}), "verdict"));
}

// What one run could not decide and another could is judged again, and settled.
TEST_F(MergeTest, UndecidedDrawsAreDecidedWhereOthersAreSlow) {
  make("whole.db", {{0, 500}});
  {
    schema::UnitRecord unit = work_off(evaluator_, {0, 500});
    const std::uint64_t draw = unit.candidates.back().draw;
    unit.candidates.pop_back();
    --unit.accepted;
    unit.undecided.push_back({draw, {7, solver::Fault::undecided, -1, solver::PathEnd::stalled}});
    schema::Catalogue catalogue(path("b.db"), evaluator_.campaign(), evaluator_.mechanism());
    catalogue.begin_run(run_, {{0, 3000}, {}, {}});
    catalogue.commit({unit});
    catalogue.end_run("stopped");
  }
  EXPECT_EQ(state("b.db").undecided, 1u);
  for (const auto& order : {std::vector{"b.db", "whole.db"}, {"whole.db", "b.db"}}) {
    const MergeReport report = join({path(order[0]), path(order[1])});
    for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
    EXPECT_EQ(report.decided, order[0] == std::string("b.db") ? 1u : 0u);
    EXPECT_EQ(state("all.db").digest, state("whole.db").digest);
  }
}

TEST_F(MergeTest, WhatCannotBeJoinedIsRefused) {
  const auto cause = [&](const std::vector<std::string>& inputs) -> std::optional<schema::Cause> {
    try {
      join(inputs);
      return std::nullopt;
    } catch (const schema::UserError& error) {
      return error.cause();
    }
  };
  const auto a = make("a.db", {{0, 100}});
  EXPECT_EQ(cause({a, path("none.db")}), schema::Cause::bad_input);
  {
    const DrawEvaluator other(schema::read_campaign(
        Json::parse(R"({"pattern": {"family": "miura", "rows": 4, "columns": 4}, "seed": 2})"),
        "test"));
    schema::Catalogue catalogue(path("other.db"), other.campaign(), other.mechanism());
    catalogue.begin_run(run_, {});
    catalogue.end_run("stopped");
  }
  EXPECT_EQ(cause({a, path("other.db")}), schema::Cause::foreign);
  make("mixed.db", {{100, 200}});
  change("mixed.db", "UPDATE run SET golden_verdicts = 'others'");
  EXPECT_EQ(cause({a, path("mixed.db")}), schema::Cause::foreign);
  EXPECT_FALSE(std::filesystem::exists(path("all.db")));
  EXPECT_TRUE(
      merge({path("all.db"), {a, path("mixed.db")}, run_, schema::Builds::mixed}).findings.empty());
  EXPECT_THROW(merge({path("all.db"), {a}, run_, schema::Builds::same}), schema::UserError);
  EXPECT_EQ(state("all.db").draws_in_ledger, 200u);  // the refused one did it no harm
}

// Rows that a catalogue's checks forbid, and that its ledger's sums do not show.
TEST_F(MergeTest, RowsThatNoCatalogueMayHoldAreRefused) {
  for (const std::string column : {"displacements_mm", "elongation"}) {
    std::filesystem::remove(path("a.db"));
    make("a.db", {{0, 100}});
    change("a.db", "PRAGMA ignore_check_constraints = ON; UPDATE candidate SET " + column +
                       " = 'nonsense'");
    EXPECT_TRUE(disagrees(join({path("a.db")}), "rows that break (json_valid(" + column + "))"));
    EXPECT_FALSE(something_written());
  }
}

// The ledger of an older schema goes in as it is.
TEST_F(MergeTest, OlderSchemas) {
  const std::string fixtures = std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/";
  const auto one = fixtures + "catalogue-7-from-1.db", two = fixtures + "catalogue-7-from-2.db";
  std::vector<std::string> inputs = {one, two};
  const MergeReport report = merge({path("all.db"), inputs, run_, schema::Builds::mixed});
  for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
  const schema::CatalogueState merged = state("all.db");
  EXPECT_EQ(merged.draws_in_ledger, 60u);
  EXPECT_EQ(report.compared, 40u);
  EXPECT_EQ(merged.accepted, 35u);
}

// An undecided draw that has a row by the rule of its unit, and would have none by today's, keeps
// one when it is decided.
TEST_F(MergeTest, DecidedDrawsKeepTheirRows) {
  constexpr std::uint64_t kDraw = 268436480;  // 2^28 + 1024, of unit 268436470
  std::filesystem::copy_file(
      std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7-from-3.db", path("old.db"));
  DrawEvaluator evaluator(
      schema::read_campaign_of(*schema::open_for_reading(path("old.db")), "old.db"));
  { schema::Catalogue(path("old.db"), evaluator.campaign(), evaluator.mechanism()); }
  const std::string draw = std::to_string(kDraw);
  change("old.db",
         "INSERT INTO undecided (draw, unit, cause, run) SELECT draw, unit, 'stalled', 3 "
         "FROM candidate WHERE draw = " +
             draw +
             ";"
             "DELETE FROM candidate WHERE draw = " +
             draw +
             ";"
             "UPDATE unit SET accepted = accepted - 1, undecided = 1 WHERE lo = 268436470;"
             "UPDATE fault_sample SET first_fault = 'undecided' WHERE draw = " +
             draw);
  EXPECT_TRUE(work_off(evaluator, {kDraw, kDraw + 1}).fault_sample.empty());
  {
    schema::Catalogue catalogue(path("old.db"), evaluator.campaign(), evaluator.mechanism());
    catalogue.begin_run(run_, {}, schema::Builds::mixed);
    catalogue.settle(judge_again(evaluator, kDraw));
    catalogue.end_run("stopped");
  }
  const auto database = schema::open_for_reading(path("old.db"));
  EXPECT_EQ(schema::query_table(*database,
                                "SELECT first_fault, deploys_from_sample, stands_for FROM "
                                "fault_sample WHERE draw = " +
                                    draw,
                                schema::TableStyle::csv),
            "first_fault,deploys_from_sample,stands_for\nnot_monotone,178,1024\n");
}

// A catalogue whose rows are denser than today's goes in with a new one of the same draws: rows
// that both have are compared, none is lost, and what is made again has those of today's rule.
TEST_F(MergeTest, DenserFaultSamples) {
  const std::string old =
      std::string(MISALIGN_SOURCE_DIR) + "/tests/fixtures/catalogue-7-from-3.db";
  constexpr std::uint64_t k2_28 = 268435456;
  const auto in = [&](const std::string& sql) {
    std::filesystem::copy_file(old, path("old.db"),
                               std::filesystem::copy_options::overwrite_existing);
    change("old.db", sql);
    std::filesystem::remove(path("all.db"));
    return merge({path("all.db"), {path("old.db"), path("new.db")}, run_, schema::Builds::mixed});
  };
  DrawEvaluator evaluator(schema::read_campaign_of(*schema::open_for_reading(old), old));
  {
    schema::Catalogue catalogue(path("new.db"), evaluator.campaign(), evaluator.mechanism());
    catalogue.begin_run(run_, {});
    // Over the old units' ends, longer than they are: those from 2^28 on are compared.
    catalogue.commit({work_off(evaluator, {k2_28 - 10, k2_28 + 20}),
                      work_off(evaluator, {k2_28 + 1010, k2_28 + 1060})});
    catalogue.end_run("stopped");
  }
  EXPECT_EQ(schema::draws_of(*schema::open_for_reading(path("new.db")), "fault_sample",
                             {1, schema::kEndOfDraws}),
            (std::vector<std::uint64_t>{k2_28}));
  const MergeReport report = in("");
  for (const auto& finding : report.findings) ADD_FAILURE() << finding.sentence;
  EXPECT_EQ(report.compared, 20u + 20u + 10u);
  EXPECT_EQ(report.recomputed, 0u);
  // A row that both have and that differs is named; one that only the old one has is not missed.
  EXPECT_TRUE(disagrees(in("UPDATE fault_sample SET first_fault = 'over_folded' WHERE draw = " +
                           std::to_string(k2_28)),
                        "fault_sample"));
  EXPECT_TRUE(in("UPDATE fault_sample SET first_fault = 'over_folded' WHERE draw = " +
                 std::to_string(k2_28 + 1024))
                  .findings.empty());
}

}  // namespace
}  // namespace misalign::search
