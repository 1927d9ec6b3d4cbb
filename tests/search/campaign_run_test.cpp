// Ranks that would misread each other are refused.
#include "search/ranks/campaign_run.hpp"

#include <gtest/gtest.h>

namespace misalign::search {
namespace {

TEST(CampaignRun, RanksThatSendAnotherLayoutAreNamedWithTheirHosts) {
  std::vector<RankInfo> ranks = {{"one", "a", ""}, {"one", "a", "x"}, {"two", "a", ""}};
  EXPECT_NO_THROW(expect_one_layout(ranks));
  ranks[2].layout = "b";
  try {
    expect_one_layout(ranks);
    FAIL();
  } catch (const schema::UserError& error) {
    EXPECT_STREQ(error.what(),
                 "rank 2 on two sends its results in another layout than rank 0 on one (another "
                 "build); put the same program on every host");
  }
}

}  // namespace
}  // namespace misalign::search
