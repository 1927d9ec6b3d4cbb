#include "search/verbs/border.hpp"

#include <gtest/gtest.h>

#include <set>

namespace misalign::search {
namespace {

using schema::Cause;

// README.md: "Exit codes".
TEST(Border, EveryCauseHasTheExitCodeOfTheContract) {
  const std::pair<Cause, int> kContract[] = {{Cause::failure, 1},   {Cause::bad_request, 2},
                                             {Cause::bad_input, 3}, {Cause::in_use, 4},
                                             {Cause::foreign, 5},   {Cause::check_failed, 6}};
  std::set<int> codes;
  for (const auto& [cause, code] : kContract) {
    EXPECT_EQ(exit_code_of(cause), code);
    EXPECT_EQ(kCommandLine.exit_code(cause), code);
    codes.insert(exit_code_of(cause));
  }
  EXPECT_EQ(codes.size(), std::size(kContract));
}

TEST(Border, ParametersAreOptions) {
  const std::tuple<const char*, bool, const char*> kOptions[] = {
      {"from_deg", true, "--from "},
      {"rest_deg", true, "--rest-deg "},
      {"rest", true, "--rest "},
      {"hinge_rest_deg", true, "--hinge-rest "},
      {"stiffness_n_per_mm", true, "--stiffness "},
      {"dash_mm", true, "--dash-mm "},
      {"bore_edge_mm", false, "--bore-edge"},
      {"allow_mixed_builds", false, "--allow-mixed-builds"}};
  for (const auto& [parameter, has_value, option] : kOptions) {
    EXPECT_EQ(option_of(parameter, has_value), option);
  }
  const schema::UserError error(solver::OptionFault{"from_deg", "200", "why", "try 36"});
  EXPECT_EQ(error.sentence(option_of), "--from 200: why; try 36");
}

}  // namespace
}  // namespace misalign::search
