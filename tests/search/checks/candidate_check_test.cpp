#include "search/checks/candidate_check.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/exchange/folding_json.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"

namespace misalign::search {
namespace {

using schema::Json;

// Candidates of a small campaign, as rows of a catalogue.
class CandidateRows : public testing::Test {
 protected:
  static schema::Campaign campaign() {
    return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                  {"path", {{"end_deg", 60}}},
                                  {"accept", {{"deploys_from_deg", 40}}}},
                                 "a test");
  }
  static std::vector<Json> rows() {
    DrawEvaluator evaluator(campaign());
    const schema::UnitRecord unit = work_off(evaluator, {0, 40});
    std::vector<Json> rows;
    for (const schema::Candidate& candidate : unit.candidates) {
      Json row = schema::metrics_json(candidate.metrics);
      row["draw"] = candidate.draw;
      row["unit"] = 0;
      row["displacements_mm"] = schema::displacements_json(candidate.shifts_mm).dump();
      Json elongation = Json::array();
      for (const double e : candidate.metrics.elongation) {
        elongation.push_back(std::round(e * 1e9) / 1e9);
      }
      row["elongation"] = elongation.dump();
      rows.push_back(row);
    }
    return rows;
  }
  const schema::Campaign campaign_ = campaign();
  const CandidateCheck check_{campaign_};
};

TEST_F(CandidateRows, GoodOnesRaiseNothing) {
  const auto all = rows();
  ASSERT_GT(all.size(), 10u);
  for (const Json& row : all) {
    const CandidateReport report = check_.check(row);
    EXPECT_TRUE(report.findings.empty()) << report.findings.front().sentence;
    EXPECT_GT(report.shape.length_mm, 0);  // rounding: something was looked at
    EXPECT_GT(report.shape.angle_deg, 0);
    EXPECT_FALSE(report.first_contact_deg);
  }
}

// One cell at a time: that column is named, and no other.
TEST_F(CandidateRows, EveryAlteredColumnIsNamed) {
  const Json row = rows().front();
  for (const auto& [column, value] : row.items()) {
    if (column == "draw" || column == "unit") continue;  // the ledger's
    Json altered = row;
    if (value.is_number_integer()) {
      altered[column] = value.get<int>() + 1;
    } else if (column == "residual_max") {
      altered[column] = 3e-12;
    } else if (column == "bump_deg" || value.is_null()) {  // known to a thousandth of a degree
      altered[column] = value.is_null() ? 40.0 : value.get<double>() + 0.01;
    } else if (value.is_number()) {
      altered[column] = value.get<double>() * (1 + 1e-4) + 1e-8;
    } else if (column == "elongation") {
      Json list = Json::parse(value.get<std::string>());
      list[2] = list[2].get<double>() + 1e-9;  // the last digit stored
      altered[column] = list.dump();
    } else {
      Json shifts = Json::parse(value.get<std::string>());
      shifts.begin().value()[0] = -shifts.begin().value()[0].get<double>() + 0.1;
      altered[column] = shifts.dump();
    }
    const auto findings = check_.check(altered).findings;
    ASSERT_FALSE(findings.empty()) << column;
    EXPECT_EQ(findings.front().details.at("column"), column);
    if (column != "displacements_mm") {
      EXPECT_EQ(findings.size(), 1u) << column;
    }
    EXPECT_NE(findings.front().sentence.find("draw " + row.at("draw").dump()), std::string::npos);
  }
}

// What was drawn, of a campaign that no file can ask for: shifts nearly as long as a panel's edge.
TEST_F(CandidateRows, ASheetWithoutConvexFacetsIsNamed) {
  schema::Campaign wild = campaign();
  wild.misalignment.amplitude_mm = 60;
  const Eigen::Matrix2Xd shifts_mm = shifts_of_draw(wild, 3);
  const solver::CreasePattern& sheet = wild.pattern.base.sheet;
  ASSERT_FALSE(solver::nonconvex_facets(sheet, sheet.vertices_mm + shifts_mm).empty());
  Json row = rows().front();
  row["draw"] = 3;
  row["displacements_mm"] = schema::displacements_json(shifts_mm).dump();
  const auto findings = CandidateCheck(wild).check(row).findings;
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.front().details.at("stored"), row.at("displacements_mm"));
  EXPECT_EQ(findings.front().details.at("recomputed"), "shifts that leave every facet convex");
}

// Its limit, 2e-12 of a panel's width, from both sides.
TEST_F(CandidateRows, AMarginIsKnownToRounding) {
  const Json row = rows().front();
  const double width_mm = campaign_.pattern.base.sheet.panel_width_mm;
  for (const double widths : {-6e-11, -1.5e-11, 1.5e-11, 6e-11}) {
    Json altered = row;
    altered["miscut_margin_mm"] = row.at("miscut_margin_mm").get<double>() + widths * width_mm;
    EXPECT_EQ(check_.check(altered).findings.size(), std::abs(widths) > 3e-11 ? 1u : 0u) << widths;
  }
}

TEST_F(CandidateRows, WhatIsNoNumberOrNoShiftIsNamed) {
  const Json row = rows().front();
  for (const auto& [column, value] : {std::pair("slope_min_mm_per_deg", Json()),
                                      {"displacements_mm", Json("3")},
                                      {"displacements_mm", Json(R"({"A99": [1, 2]})")},
                                      {"displacements_mm", Json("{")},
                                      {"displacements_mm", Json()},
                                      {"draw", Json("x")},
                                      {"elongation", Json(7)},
                                      {"elongation", Json("[1]")},
                                      {"elongation", Json("{}")},
                                      {"later", Json(1)}}) {
    Json altered = row;
    altered[column] = value;
    const auto findings = check_.check(altered).findings;
    ASSERT_FALSE(findings.empty()) << column;
    EXPECT_EQ(findings.front().details.at("column"), column);
  }
  for (const char* column : {"stroke_max", "draw", "displacements_mm", "elongation"}) {
    Json less = row;
    less.erase(column);
    const auto findings = check_.check(less).findings;
    ASSERT_EQ(findings.size(), 1u) << column;
    EXPECT_EQ(findings.front().details.at("column"), column);
  }
  EXPECT_EQ(check_.check(nullptr).findings.size(), 1u);
  // What was written before a column was there has none of it, or null in it.
  const auto written_by = [&row](int version) {
    Json older = row;
    for (const schema::MetricEntry& metric : schema::metric_table()) {
      if (metric.age.first > version) older[metric.name] = nullptr;
    }
    return older;
  };
  EXPECT_TRUE(written_by(3).at("miscut_margin_mm").is_null());
  EXPECT_TRUE(check_.check(written_by(3), 3).findings.empty());
  EXPECT_FALSE(check_.check(written_by(3)).findings.empty());
  Json older = written_by(1);
  EXPECT_TRUE(older.at("bump_deg").is_null());
  EXPECT_TRUE(check_.check(older, 1).findings.empty());
  EXPECT_FALSE(check_.check(older).findings.empty());
  // What has another meaning by now is noted; what has none is as wrong as ever.
  Json altered = written_by(2);
  altered["bump_deg"] = 40.0;
  altered["slope_between_min_mm_per_deg"] = -1.0;
  const CandidateReport by_then = check_.check(altered, 2);
  EXPECT_TRUE(by_then.findings.empty());
  EXPECT_EQ(by_then.not_comparable.size(), 2u);
  Json altered_now = row;
  altered_now["bump_deg"] = 40.0;
  altered_now["slope_between_min_mm_per_deg"] = -1.0;
  EXPECT_EQ(check_.check(altered_now).findings.size(), 2u);
  Json by_cubics = written_by(6);
  by_cubics["reverses_at_deg"] = 40.0;
  EXPECT_TRUE(check_.check(by_cubics, 6).findings.empty());
  EXPECT_EQ(check_.check(by_cubics, 6).not_comparable, std::vector<std::string>{"reverses_at_deg"});
  altered["stroke_max"] = 1.0;
  EXPECT_EQ(check_.check(altered, 2).findings.size(), 1u);
  older.erase("slope_between_min_mm_per_deg");
  older.erase("bump_deg");
  EXPECT_TRUE(check_.check(older, 1).findings.empty());
}

}  // namespace
}  // namespace misalign::search
