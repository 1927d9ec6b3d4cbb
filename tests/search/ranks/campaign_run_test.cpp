// Ranks that would misread each other are refused.
#include "search/ranks/campaign_run.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

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
                 "rank 2 on two sends its results in another layout than rank 0 on one (it is "
                 "another build); install the same build on every host");
  }
}

// A rank that is asked to leave: the main thread is at work at first, then where it may be left.
TEST(CampaignRun, AMainThreadIsLeftFromSafePlacesOnly) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto leave_from = [](LeftFrom from) {
    bool is_done = false;
    watch_for_signals();
    const Departure departure(0, from, [&] { return is_done ? 7 : 8; });
    std::raise(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    is_done = true;
    const MayBeLeft computing;
    std::this_thread::sleep_for(std::chrono::minutes(5));
  };
  EXPECT_EXIT(leave_from(LeftFrom::safe_places), testing::ExitedWithCode(7), "");
  EXPECT_EXIT(leave_from(LeftFrom::anywhere), testing::ExitedWithCode(8), "");
}

// Each of them alone: who is asked twice within half a second is asked once.
TEST(CampaignRun, ASecondRequestAtOnceIsTheFirstAgain) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto ask_twice = [](std::chrono::milliseconds apart) {
    watch_for_signals();
    std::raise(SIGTERM);
    std::this_thread::sleep_for(apart);
    std::raise(SIGINT);
    _exit(9);
  };
  EXPECT_EXIT(ask_twice(std::chrono::milliseconds(0)), testing::ExitedWithCode(9), "");
  EXPECT_EXIT(ask_twice(std::chrono::milliseconds(600)), testing::ExitedWithCode(130),
              "asked twice to stop.*same command resumes");
}

}  // namespace
}  // namespace misalign::search
