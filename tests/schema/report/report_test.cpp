// The data of the report's page.
#include "schema/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/base64.hpp"
#include "schema/report/stress_result.hpp"
#include "solver/motion/actuation.hpp"
#include "solver/pattern/outline.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::schema {
namespace {

std::string base64_of(const std::string& text) {
  return base64(reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

TEST(Base64, TestVectorsOfRfc4648) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

/// The numbers that were written, by a slow decoder of its own.
template <class Number>
std::vector<Number> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bits, bytes;
  for (const char c : text) {
    if (c == '=') break;
    const auto digit = digits.find(c);
    for (int k = 5; k >= 0; --k) bits += digit >> k & 1 ? '1' : '0';
  }
  for (std::size_t k = 0; k + 8 <= bits.size(); k += 8) {
    bytes += static_cast<char>(std::stoi(bits.substr(k, 8), nullptr, 2));
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

TEST(ReportDetail, HistoriesAndShapesAreThoseOfThePath) {
  const Pattern pattern = read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  const solver::OwnSheet own(pattern.base, pattern.shifts_mm);
  const solver::Sheet& sheet = own.sheet;
  const auto actuation = solver::actuate(sheet, {});
  const Json detail = detail_json({pattern, sheet}, std::uint64_t{1} << 62, false, actuation);
  EXPECT_EQ(detail["draw"], "4611686018427387904");
  EXPECT_EQ(detail["metrics"]["deploys_from_deg"], sheet.deploys_from_deg());
  const std::size_t rows = sheet.shapes_mm().size() + 1;
  EXPECT_EQ(detail["pilot_deg"].size(), rows);
  const auto lengths = decoded<float>(detail["length_mm"]);
  ASSERT_EQ(lengths.size(), rows * 16);
  EXPECT_FLOAT_EQ(lengths[3], static_cast<float>(sheet.history().flat_mm[3]));
  EXPECT_FLOAT_EQ(lengths[100 * 16 + 5], static_cast<float>(sheet.history().length_mm(99, 5)));
  const auto energies = decoded<float>(detail["energy_n_mm"]);
  ASSERT_EQ(energies.size(), rows);
  EXPECT_FLOAT_EQ(energies[50], static_cast<float>(actuation.energy_n_mm[50]));
  EXPECT_TRUE(std::isnan(decoded<float>(detail["mechanical_advantage"])[0]));

  const auto units = decoded<std::int16_t>(detail["vertices_mm"]["data"]);
  const double unit_mm = detail["vertices_mm"]["unit_mm"];
  EXPECT_EQ(unit_mm, 0.01);
  ASSERT_EQ(units.size(), rows * 49 * 3);
  const auto distance = [&](std::size_t row, std::size_t a, std::size_t b) {
    double sq = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = units[(row * 49 + a) * 3 + k] - units[(row * 49 + b) * 3 + k];
      sq += d * d;
    }
    return std::sqrt(sq) * unit_mm;
  };
  for (const std::size_t row : {0u, 1u, 80u, 150u}) {
    for (std::size_t a = 0; a < 49; ++a) {
      const double wanted = row == 0
                                ? (pattern.vertices_mm().col(static_cast<Eigen::Index>(a)) -
                                   pattern.vertices_mm().col(17))
                                      .norm()
                                : (sheet.shapes_mm()[row - 1].col(static_cast<Eigen::Index>(a)) -
                                   sheet.shapes_mm()[row - 1].col(17))
                                      .norm();
      EXPECT_NEAR(distance(row, a, 17), wanted, 0.02) << row << " " << a;
    }
  }
}

TEST(ReportSheet, CutsAreTheEdgesWithOnePanel) {
  const Campaign campaign = default_campaign();
  const auto& base = campaign.pattern.base;
  const auto mechanism = solver::build_mechanism(base);
  const Json sheet = sheet_json(campaign.pattern, mechanism);
  // 6 x 6 with 8 holes: 24 edges round the sheet, 4 round each hole.
  EXPECT_EQ(sheet["cuts"].size(), 24u + 8 * 4);
  EXPECT_EQ(sheet["panels"].size(), 28u);
  EXPECT_EQ(sheet["creases"].size(), 28u);
  EXPECT_EQ(sheet["ball_joints"].size(), 9u);
  EXPECT_EQ(sheet["pilot"], Json({1, 8})) << "A2-A9";
  EXPECT_EQ(sheet["creases"].size() + sheet["cuts"].size(), base.sheet.edges.size());
}

const std::string kStressFile = MISALIGN_SOURCE_DIR "/tests/fixtures/table1-stress.json";

TEST(ReportStress, PanelsAreThoseOfTheSheetInItsOrder) {
  const Pattern pattern = read_pattern_file(MISALIGN_SOURCE_DIR "/search/patterns/table1.json");
  const auto& base = pattern.base;
  const auto mechanism = solver::build_mechanism(base);
  const Json places = sheet_json(pattern, mechanism)["panel_places"];
  StressResult result = read_stress_result(kStressFile);
  EXPECT_EQ(result.whose["pattern"], "table1");
  std::reverse(result.panels_mpa.begin(), result.panels_mpa.end());  // in any order
  const Json shown = stress_shown_json(result, pattern);
  const Json file = read_json_file(kStressFile);
  ASSERT_EQ(shown["panels_mpa"].size(), 28u);
  ASSERT_EQ(places.size(), 28u);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto same = [&](const Json& entry) { return entry["panel"] == places[k]; };
    const auto at = std::find_if(file["panels"].begin(), file["panels"].end(), same);
    ASSERT_NE(at, file["panels"].end()) << places[k];
    EXPECT_EQ(shown["panels_mpa"][k], (*at)["outside_discs_mpa"]) << places[k];
  }
  EXPECT_EQ(shown["largest"]["stress_mpa"], file["largest_outside_discs"]["stress_mpa"]);
  const auto pilot_deg = decoded<float>(shown["motion"]["pilot_deg"]);
  ASSERT_EQ(pilot_deg.size(), file["motion"]["pilot_deg"].size());
  EXPECT_FLOAT_EQ(pilot_deg[0], 36);
}

TEST(ReportStress, OfAnotherSheetIsRefused) {
  StressResult result = read_stress_result(kStressFile);
  const Campaign campaign = default_campaign();
  EXPECT_NO_THROW(stress_shown_json(result, campaign.pattern)) << "the same panels";
  result.panels_mpa.back().first = result.panels_mpa.front().first;
  try {
    stress_shown_json(result, campaign.pattern);
    FAIL() << "a panel that is there twice";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_input);
    EXPECT_NE(std::string(error.what()).find("its panels are not"), std::string::npos);
  }
}

// The material lies on the left of every walk: areas are positive outside and negative in holes.
TEST(Outlines, GoRoundTheMaterial) {
  const Campaign campaign = default_campaign();
  const auto& base = campaign.pattern.base;
  const auto walks = solver::outlines(base.sheet, base.holes);
  ASSERT_EQ(walks.size(), 1 + base.holes.size());
  EXPECT_EQ(walks[0].size(), 24u);
  double area_mm2 = 0;
  for (const auto& walk : walks) {
    double twice = 0;
    for (std::size_t k = 0; k < walk.size(); ++k) {
      const auto p = base.sheet.vertices_mm.col(walk[k]);
      const auto q = base.sheet.vertices_mm.col(walk[(k + 1) % walk.size()]);
      twice += p.x() * q.y() - p.y() * q.x();
    }
    EXPECT_EQ(twice > 0, &walk == &walks[0]);
    area_mm2 += twice / 2;
  }
  // The sheet is 480 mm high and 480 or 520 mm wide in turns; the holes are 8 panels of 80 x 80.
  EXPECT_NEAR(area_mm2, 480 * 520 - 8 * 80 * 80, 1e-6);
}

}  // namespace
}  // namespace misalign::schema
