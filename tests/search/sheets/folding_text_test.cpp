#include "search/sheets/folding_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/text_table.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "solver/records/record_sheet.hpp"

namespace misalign::search {
namespace {

schema::Campaign campaign(int side) {
  return schema::read_campaign(
      {{"pattern", {{"family", "miura"}, {"rows", side}, {"columns", side}}},
       {"accept", {{"deploys_from_deg", 150}}}},
      "a test");
}

std::string text_of(DrawEvaluator& evaluator, std::uint64_t draw,
                    const FoldingTextOptions& options) {
  solver::SheetSolver solver(evaluator.model());
  const solver::Sheet sheet(solver, evaluator.shifts_mm(draw));
  return folding_text({evaluator.campaign().pattern, sheet}, options);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Sparkline, GoesFromTheLeastToTheLargest) {
  EXPECT_EQ(sparkline({0, 1, 2, 3, 4, 5, 6, 7}, true), "▁▂▃▄▅▆▇█");
  EXPECT_EQ(sparkline({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, false),
            "__..::--==++**##");  // all equally high
  EXPECT_EQ(sparkline({7, 0}, true), "█▁");
  EXPECT_EQ(sparkline({-3, -3, -3}, true), "▁▁▁");
  EXPECT_EQ(sparkline({}, true), "");
  EXPECT_EQ(sparkline({1e-9, 2e-9, 1.5e-9}, false).size(), 3u);
  EXPECT_EQ(sparkline({0, 1, 0}, false), "_#_");
}

TEST(FoldingText, FitsTheTerminal) {
  for (const int side : {4, 6, 8}) {
    DrawEvaluator evaluator(campaign(side));
    solver::SheetSolver solver(evaluator.model());
    for (std::uint64_t draw = 0; draw < 5; ++draw) {
      const solver::Sheet sheet(solver, evaluator.shifts_mm(draw));
      const schema::FoldingView view(evaluator.campaign().pattern, sheet);
      for (const int width : {80, 100, 200}) {
        for (const bool utf8 : {false, true}) {
          for (const std::string& line : lines_of(folding_text(view, {width, utf8}))) {
            EXPECT_LE(schema::display_width(line), static_cast<std::size_t>(width)) << line;
          }
        }
      }
    }
  }
}

// Every diagonal has a line, whose lengths are the history's and whose signs go as they do.
TEST(FoldingText, SaysWhatTheHistorySays) {
  DrawEvaluator evaluator(campaign(4));
  for (std::uint64_t draw = 0; draw < 20; ++draw) {
    const auto history = solver::record_history(
        evaluator.model(), evaluator.model().base().sheet.vertices_mm + evaluator.shifts_mm(draw));
    const auto d = static_cast<Eigen::Index>(history.verdict.deploys_from_sample) - 1;
    if (d < 0) continue;
    const std::vector<std::string> lines = lines_of(text_of(evaluator, draw, {200, false}));
    for (std::size_t k = 0; k < evaluator.mechanism().diagonals.size(); ++k) {
      const solver::Diagonal& diagonal = evaluator.mechanism().diagonals[k];
      const std::string name = solver::line_label(diagonal.from, diagonal.to) + " ";
      const auto line = std::find_if(lines.begin(), lines.end(), [&](const std::string& one) {
        return one.rfind(name, 0) == 0;
      });
      ASSERT_NE(line, lines.end()) << name;
      std::istringstream words(*line);
      std::string label, hole, direction, drawn;
      double flat_mm = 0, at_mm = 0, least = 0, most = 0;
      words >> label >> hole >> flat_mm >> at_mm >> direction >> least >> most >> drawn;
      const double length_mm = history.length_mm(d, static_cast<Eigen::Index>(k));
      EXPECT_NEAR(flat_mm, history.flat_mm[k], 6e-4);
      EXPECT_NEAR(at_mm, length_mm, 6e-4);
      const double change = 100 * (length_mm / history.flat_mm[k] - 1);
      EXPECT_EQ(direction, change > 0 ? "increasing" : "decreasing");
      // Monotone up to D: one end of the range is flat, the other is at D.
      EXPECT_NEAR(least, std::min(change, 0.0), 6e-3) << *line;
      EXPECT_NEAR(most, std::max(change, 0.0), 6e-3) << *line;
      // Up to the bar at D the signs go one way.
      const std::string up_to_d = drawn.substr(0, drawn.find('|'));
      const std::string heights = "_.:-=+*#";
      for (std::size_t c = 1; c < up_to_d.size(); ++c) {
        const auto before = heights.find(up_to_d[c - 1]), now = heights.find(up_to_d[c]);
        EXPECT_TRUE(change > 0 ? now >= before : now <= before) << *line;
      }
      const double end_deg = history.stations.back().pilot_deg, d_deg = static_cast<double>(d + 1);
      if (end_deg > d_deg + 10) {
        ASSERT_NE(drawn.find('|'), std::string::npos) << *line;
        EXPECT_NEAR(static_cast<double>(up_to_d.size()) / static_cast<double>(drawn.size()),
                    d_deg / end_deg, 0.04)
            << *line;
      }
    }
  }
}

// A diagonal that varies by less than model.md's inactive band, 1e-8 panel widths, is drawn still;
// one that varies by more is not.
TEST(FoldingText, RoundingIsNotDrawnAsMotion) {
  DrawEvaluator evaluator(campaign(4));
  auto history = solver::record_history(
      evaluator.model(), evaluator.model().base().sheet.vertices_mm + evaluator.shifts_mm(0));
  solver::SheetSolver solver(evaluator.model());
  const solver::Sheet sheet(solver, evaluator.shifts_mm(0));
  const double band_mm = 1e-8 * 80;
  for (Eigen::Index row = 0; row < history.length_mm.rows(); ++row) {
    const double up_and_down = row % 2 == 0 ? 1 : 0;
    history.length_mm(row, 0) = history.flat_mm[0] + 0.99 * band_mm * up_and_down;
    history.length_mm(row, 1) = history.flat_mm[1] + 1.01 * band_mm * up_and_down;
  }
  const std::vector<std::string> lines =
      lines_of(folding_text({evaluator.campaign().pattern, sheet, history}, {200, false}));
  const auto drawn_of = [&](std::size_t k) {
    const solver::Diagonal& diagonal = evaluator.mechanism().diagonals[k];
    const std::string name = solver::line_label(diagonal.from, diagonal.to) + " ";
    for (const std::string& line : lines) {
      if (line.rfind(name, 0) == 0) return line;
    }
    return std::string("no line for " + name);
  };
  EXPECT_NE(drawn_of(0).find(" still "), std::string::npos) << drawn_of(0);
  EXPECT_EQ(drawn_of(0).find('#'), std::string::npos) << drawn_of(0);
  EXPECT_EQ(drawn_of(0).find("-0.00"), std::string::npos) << drawn_of(0);
  EXPECT_NE(drawn_of(1).find('#'), std::string::npos) << drawn_of(1);
}

TEST(FoldingText, TheTableWhereItFitsOrIsAskedFor) {
  DrawEvaluator evaluator(campaign(6));
  const auto has_table = [&](int width, bool asked) {
    return text_of(evaluator, 0, {width, true, asked}).find("\npilot_deg") != std::string::npos;
  };
  EXPECT_FALSE(has_table(80, false));
  EXPECT_TRUE(has_table(80, true));
  EXPECT_TRUE(has_table(200, false));
  EXPECT_EQ(text_of(evaluator, 0, {80, true}).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace misalign::search
