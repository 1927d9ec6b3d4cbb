// Raised ends in JSON: absent if not tried, empty where no springs touch.
#include "schema/exchange/spring_clearance_json.hpp"

#include <gtest/gtest.h>

namespace misalign::schema {
namespace {

TEST(SpringClearanceJson, TellsATrialThatFindsNothingFromNone) {
  solver::ContactStudy study;
  study.springs.emplace();
  EXPECT_FALSE(spring_clearance_json({}, {}, study).contains("offset_ends"));
  study.trial = solver::OffsetTrial::tried;
  EXPECT_EQ(spring_clearance_json({}, {}, study).at("offset_ends"), Json::array());
}

}  // namespace
}  // namespace misalign::schema
