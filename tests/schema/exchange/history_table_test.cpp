// Long tables against what JSON says of the same folding, read with a plain reader of CSV.
#include "schema/exchange/history_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "schema/exchange/actuators_json.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

using NamedRow = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> cells;
  std::string rest = line + ",";
  for (std::size_t at; (at = rest.find(',')) != std::string::npos; rest.erase(0, at + 1)) {
    cells.push_back(rest.substr(0, at));
  }
  return cells;
}

std::vector<NamedRow> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const auto names = cells(line);
  std::vector<NamedRow> rows;
  while (std::getline(lines, line)) {
    const auto values = cells(line);
    EXPECT_EQ(values.size(), names.size()) << line;
    NamedRow row;
    for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) {
      row[names[k]] = values[k];
    }
    rows.push_back(row);
  }
  return rows;
}

class HistoryTable : public testing::Test {
 protected:
  const Pattern pattern_ = read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  const solver::OwnSheet own_{pattern_.base, pattern_.shifts_mm, {1, 40, 0}};
  const solver::Actuation actuation_ =
      solver::actuate(own_.sheet, {solver::Springs{.stiffness_n_per_mm = 20}, {}});
  const FoldingView view_{pattern_, own_.sheet};
  const RowKey key_{"draw", "7"};
};

TEST_F(HistoryTable, HasARowForEachStopAndDiagonal) {
  const auto rows = rows_of(diagonal_columns(key_) + diagonal_rows(key_, view_, actuation_));
  const Json folding = folding_json(view_);
  const Json history = actuation_history_json(view_, actuation_);
  const std::size_t diagonals = folding["diagonals"].size();
  ASSERT_EQ(rows.size(), 41 * diagonals);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const NamedRow& row = rows[k];
    const std::size_t stop = k / diagonals, d = k % diagonals;
    const Json& diagonal = folding["diagonals"][d];
    EXPECT_EQ(row.at("draw"), "7");
    EXPECT_EQ(std::stod(row.at("pilot_deg")), static_cast<double>(stop));
    EXPECT_EQ(row.at("diagonal"), diagonal["diagonal"].dump());
    EXPECT_EQ(row.at("diagonal"), std::to_string(d));
    EXPECT_EQ(row.at("from_vertex"), diagonal["from"]);
    EXPECT_EQ(row.at("to_vertex"), diagonal["to"]);
    EXPECT_EQ("[" + row.at("hole_row") + "," + row.at("hole_column") + "]",
              diagonal["hole"].dump());
    const double flat_mm = diagonal["flat_mm"];
    const double length_mm = stop == 0 ? flat_mm : diagonal["length_mm"][stop - 1].get<double>();
    EXPECT_NEAR(std::stod(row.at("length_mm")), length_mm, 1e-9);
    EXPECT_NEAR(std::stod(row.at("elongation")), length_mm / flat_mm - 1, 1e-9) << "a share";
    EXPECT_NEAR(std::stod(row.at("force_n")), 20 * (length_mm - flat_mm), 1e-6);
    EXPECT_EQ(row.at("mechanical_advantage").empty(), stop == 0);
  }
  for (std::size_t stop = 0; stop < 41; ++stop) {
    double energy_n_mm = 0, moment_n_mm = 0;
    for (std::size_t d = 0; d < diagonals; ++d) {
      energy_n_mm += std::stod(rows[stop * diagonals + d].at("energy_n_mm"));
      moment_n_mm += std::stod(rows[stop * diagonals + d].at("moment_n_mm"));
    }
    EXPECT_NEAR(energy_n_mm, history["history"]["energy_n_mm"][stop].get<double>(), 1e-6);
    EXPECT_NEAR(moment_n_mm, history["history"]["moment_n_mm"][stop].get<double>(), 1e-6);
  }
}

TEST_F(HistoryTable, HasARowForEachStopAndCrease) {
  const auto rows = rows_of(crease_columns(key_) + crease_rows(key_, view_));
  const Json folding = folding_json(view_);
  const std::size_t creases = folding["creases"].size();
  ASSERT_EQ(rows.size(), 41 * creases);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t stop = k / creases;
    const Json& crease = folding["creases"][k % creases];
    EXPECT_EQ(rows[k].at("crease"), crease["crease"].dump());
    EXPECT_EQ(rows[k].at("from_vertex"), crease["from"]);
    EXPECT_EQ(rows[k].at("to_vertex"), crease["to"]);
    EXPECT_EQ(rows[k].at("assignment"), crease["assignment"]);
    const double angle_deg = stop == 0 ? 0.0 : crease["fold_angle_deg"][stop - 1].get<double>();
    EXPECT_NEAR(std::stod(rows[k].at("fold_angle_deg")), angle_deg, 1e-9);
  }
}

// Fewer angles: of the rows of all angles those at multiples, the flat ones and those at D.
TEST_F(HistoryTable, IsThinnedToMultiplesAndD) {
  const auto angles_of = [](const std::vector<NamedRow>& rows) {
    std::vector<double> angles_deg;
    for (const NamedRow& row : rows) {
      const double angle_deg = std::stod(row.at("pilot_deg"));
      if (angles_deg.empty() || angles_deg.back() != angle_deg) angles_deg.push_back(angle_deg);
    }
    return angles_deg;
  };
  solver::FoldingHistory history = own_.sheet.history();
  history.verdict.deploys_from_sample = 37;
  const FoldingView view(pattern_, own_.sheet, history);
  const std::vector<std::pair<double, std::vector<double>>> kinds = {
      {15, {0, 15, 30, 37}}, {7.5, {0, 15, 30, 37}}, {37, {0, 37}}, {180, {0, 37}}};
  const auto all = rows_of(diagonal_columns(key_) + diagonal_rows(key_, view, actuation_));
  for (const auto& [every_deg, angles_deg] : kinds) {
    const auto rows =
        rows_of(diagonal_columns(key_) + diagonal_rows(key_, view, actuation_, every_deg));
    EXPECT_EQ(angles_of(rows), angles_deg) << every_deg;
    for (const NamedRow& row : rows) EXPECT_NE(std::find(all.begin(), all.end(), row), all.end());
    EXPECT_EQ(angles_of(rows_of(crease_columns(key_) + crease_rows(key_, view, every_deg))),
              angles_deg);
  }
  EXPECT_EQ(diagonal_rows(key_, view, actuation_, 1), diagonal_rows(key_, view, actuation_));
}

// A pattern's name is whatever its file's is.
TEST_F(HistoryTable, NamesAreQuotedWhereTheyMustBe) {
  const RowKey key{"pattern", "mine, \"best\""};
  EXPECT_EQ(crease_columns(key).substr(0, 8), "pattern,");
  EXPECT_EQ(crease_rows(key, view_).substr(0, 22), "\"mine, \"\"best\"\"\",0,0,A");
}

}  // namespace
}  // namespace misalign::schema
