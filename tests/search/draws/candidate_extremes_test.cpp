// The first reversals of candidates' diagonals, and the least rates of change, against vertex
// coordinates: of draws next to whose fold limit, or next to D, both are hard to know.
#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/catalogue/metric_table.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "tests/solver/coordinate_extremes.hpp"

namespace misalign::search {
namespace {

void expect_same(const char* column, const std::optional<double>& value,
                 const std::optional<double>& expected, double width_mm) {
  ASSERT_EQ(value.has_value(), expected.has_value()) << column;
  if (!value) return;
  const schema::Allowance& allowance = schema::find_metric(column)->allowance;
  EXPECT_TRUE(allowance.allows(*value, *expected, width_mm, 1))
      << column << ": " << *value << " instead of " << *expected;
}

void expect_extremes_of_coordinates(DrawEvaluator& evaluator, std::uint64_t draw) {
  SCOPED_TRACE("draw " + std::to_string(draw));
  const schema::UnitRecord unit = work_off(evaluator, {draw, draw + 1});
  ASSERT_EQ(unit.candidates.size(), 1u);
  const solver::Metrics& metrics = unit.candidates.front().metrics;
  const solver::PerforatedSheet& base = evaluator.campaign().pattern.base;
  const solver::CoordinateExtremes expected = coordinate_extremes(
      base, evaluator.mechanism(), base.sheet.vertices_mm + unit.candidates.front().shifts_mm, 1,
      metrics.deploys_from_sample, metrics.fold_limit_deg);
  ASSERT_TRUE(expected.is_whole);
  const double width_mm = evaluator.mechanism().panel_width_mm;
  expect_same("reverses_at_deg", metrics.reverses_at_deg, expected.reverses_deg, width_mm);
  expect_same("slope_between_min_mm_per_deg", metrics.slope_between_min_mm_per_deg,
              expected.least_slope_mm_per_deg, width_mm);
  expect_same("slope_min_mm_per_deg", metrics.slope_min_mm_per_deg, expected.least_step_mm_per_deg,
              width_mm);
}

DrawEvaluator shipped(const char* name) {
  return DrawEvaluator(schema::read_campaign_file(
      std::string(MISALIGN_SOURCE_DIR "/search/campaigns/") + name + ".json"));
}

// Paths in close steps (32798, 154, 456, 483; 149913 and 192731 with segments next to 180 degrees
// and to a sharp bend), and functions whose slope is least at D.
TEST(CandidateExtremes, AreThoseOfVertexCoordinates) {
  DrawEvaluator evaluator = shipped("miura-4x4");
  for (const std::uint64_t draw : {32798, 154, 456, 483, 27281, 111, 392, 149913, 192731}) {
    expect_extremes_of_coordinates(evaluator, draw);
  }
}

// Halfway from 172 to 173 degrees, where creases turn fast, no state is found from the mean of
// both.
TEST(CandidateExtremes, AReversalIsFoundOnAPathThatBendsSharply) {
  DrawEvaluator evaluator = shipped("double-corrugation-6x6");
  for (const std::uint64_t draw : {201358, 338185}) expect_extremes_of_coordinates(evaluator, draw);
}

// The function ends next to a fold limit, in nodes too close together to reach back to the last
// station: states before them are not foretold. (174.8 and 168.4 degrees, by an extrapolated one;
// coordinates do not get there.)
TEST(CandidateExtremes, AFoldLimitIsNotSteppedOver) {
  DrawEvaluator graded = shipped("miura-graded-6x6"), wide = shipped("miura-wide-6x6");
  expect_extremes_of_coordinates(graded, 536751);
  expect_extremes_of_coordinates(wide, 884980);
}

// A diagonal that sets out like the fourth power of the pilot's angle has a cubic that goes back.
TEST(CandidateExtremes, NoneTurnsAtFlatThatSetsOutSlowly) {
  DrawEvaluator evaluator = shipped("miura-6x6");
  expect_extremes_of_coordinates(evaluator, 195322);
}

}  // namespace
}  // namespace misalign::search
