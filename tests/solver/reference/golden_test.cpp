// Against data from three programs that share no code with this one (tests/golden).
#include "solver/reference/reference.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// The golden fold limits have four decimals.
constexpr double kFoldLimitTolerance_deg = 1e-3;

class GoldenTable1 : public testing::TestWithParam<const char*> {};

TEST_P(GoldenTable1, LengthsVerdictAndFoldLimit) {
  const Json table = golden(GetParam());
  const TestSheet sheet(table["rows"], table["columns"], table["holes"]);
  const auto history = sheet.history(sheet.shifted(table["displacements_mm"]));
  EXPECT_EQ(history.verdict.deploys_from_sample, table["deploys_from_deg"].get<int>());
  EXPECT_EQ(fault_name(history.verdict.first_fault), table["first_fault"].get<std::string>());
  EXPECT_NEAR(history.path.fold_limit_deg, table["fold_limit_deg"].get<double>(),
              kFoldLimitTolerance_deg);
  const Json& diagonals = table["diagonals"];
  ASSERT_EQ(diagonals.size(), sheet.mechanism.diagonals.size());
  double worst_mm = 0;
  for (std::size_t d = 0; d < diagonals.size(); ++d) {
    EXPECT_EQ(diagonals[d]["from"], vertex_label(sheet.mechanism.diagonals[d].from));
    EXPECT_EQ(diagonals[d]["to"], vertex_label(sheet.mechanism.diagonals[d].to));
    // Printed with eight decimals.
    EXPECT_NEAR(diagonals[d]["flat_mm"].get<double>(), history.flat_mm[d], 1e-8);
    for (std::size_t k = 0; k < table["pilot_deg"].size(); ++k) {
      const int sample = table["pilot_deg"][k];
      const double length = history.length_mm(sample - 1, static_cast<Eigen::Index>(d));
      worst_mm = std::max(worst_mm, std::abs(length - diagonals[d]["length_mm"][k].get<double>()));
    }
  }
  EXPECT_LE(worst_mm, 1e-8);
  RecordProperty("worst_length_error_mm", scientific(worst_mm));
}

INSTANTIATE_TEST_SUITE_P(Golden, GoldenTable1,
                         testing::Values("table1_odd.json", "table1_even.json"));

TEST(Golden, AllVerdictsFaultsAndFoldLimitsSlow) {
  const Json verdicts = golden("verdicts.json");
  int cases = 0;
  for (const Json& set : verdicts["sets"]) {
    const TestSheet sheet(set["rows"], set["columns"], set["holes"]);
    const PathPlan plan = sheet.plan();
    Reference reference(sheet.mechanism, plan);
    for (const Json& pattern : set["cases"]) {
      SCOPED_TRACE(pattern["displacements_mm"].dump());
      const Verdict verdict = reference.judge(sheet.shifted(pattern["displacements_mm"]));
      EXPECT_EQ(verdict.deploys_from_sample, pattern["deploys_from_deg"].get<int>());
      EXPECT_EQ(fault_name(verdict.first_fault), pattern["first_fault"].get<std::string>());
      if (pattern.contains("fold_limit_deg")) {
        EXPECT_NEAR(reference.path().fold_limit_deg, pattern["fold_limit_deg"].get<double>(),
                    kFoldLimitTolerance_deg);
      }
      ++cases;
    }
  }
  EXPECT_EQ(cases, 178);
}

// Rigid panels keep their lengths: checked on vertex coordinates, which loop closure never sees.
// Worst of all golden patterns 2e-10 mm on 80 mm panels; in proportion on others.
TEST(Golden, IsometryOnEverySampleAtEveryPanelSizeSlow) {
  const Json verdicts = golden("verdicts.json");
  double worst_ratio = 0;
  int patterns = 0;
  for (const double width_mm : {20.0, 80.0, 160.0}) {
    const auto check = [&](const Json& set, const Json& displacements_mm) {
      const TestSheet sheet(set["rows"], set["columns"], set["holes"], width_mm);
      const auto history = sheet.history(sheet.shifted(displacements_mm));
      ASSERT_FALSE(history.stations.empty());
      ++patterns;
      for (const double error_mm : history.isometry_error_mm) {
        worst_ratio = std::max(worst_ratio, error_mm / (1e-9 * width_mm / 80));
      }
    };
    for (const char* name : {"table1_odd.json", "table1_even.json"}) {
      const Json table = golden(name);
      check(table, table["displacements_mm"]);
    }
    for (const Json& set : verdicts["sets"]) {
      for (const Json& pattern : set["cases"]) check(set, pattern["displacements_mm"]);
    }
  }
  EXPECT_EQ(patterns, 3 * (2 + 178));
  EXPECT_LE(worst_ratio, 1.0);
  RecordProperty("worst_isometry_error_of_80_mm_panels_mm", scientific(1e-9 * worst_ratio));
}

}  // namespace
}  // namespace misalign::solver
