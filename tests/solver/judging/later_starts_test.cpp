// Verdicts of paths that go on in close steps where their functions ended, next to 180 degrees,
// against paths in close steps from flat on.
#include <gtest/gtest.h>

#include "solver/records/record_sheet.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

constexpr int kSample = 176;

class LaterStartsTest : public testing::TestWithParam<BumpRule> {
 protected:
  const DrawableSheet sheets_{4, 4};
  const Model model_{
      sheets_.base, sheets_.shifted_vertices, {}, kSample, {.bumps = GetParam(), .scores = true}};
};

INSTANTIATE_TEST_SUITE_P(Bumps, LaterStartsTest,
                         testing::Values(BumpRule::ignored, BumpRule::exact));

TEST_P(LaterStartsTest, VerdictsAreThoseOfPathsFromFlat) {
  const ShiftBlock drawn = sheets_.draws(8000 / kFewer, kSeed + 62);
  ShiftBlock left;
  std::vector<Verdict> expected;
  int beyond = 0;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto batch = make_batch(set, model_);
    if (left.sheets == 0) {
      const std::vector<Rejection>& rejections = batch->reject(drawn);
      std::vector<int> numbers = all_of(drawn);
      std::erase_if(numbers, [&](int i) { return rejections[i].fault != Fault::none; });
      left = chosen_of(drawn, numbers);
      for (int i = 0; i < left.sheets; ++i) {
        expected.push_back(record_history(model_, sheets_.vertices(left, i)).verdict);
        beyond += expected.back().deploys_from_sample >= kSample;
      }
    }
    const std::vector<Verdict>& verdicts = batch->judge(left);
    for (int i = 0; i < left.sheets; ++i) {
      SCOPED_TRACE(std::to_string(i) + " " + instruction_set_name(set));
      EXPECT_EQ(verdicts[i].deploys_from_sample, expected[i].deploys_from_sample);
      EXPECT_EQ(verdicts[i].first_fault, expected[i].first_fault);
      EXPECT_EQ(verdicts[i].where, expected[i].where);
      EXPECT_EQ(verdicts[i].score, expected[i].score);
    }
    // A function takes some 20; close steps from flat to 180 degrees take some 350.
    EXPECT_LT(static_cast<double>(batch->path_effort().iterations) / left.sheets, 100);
  }
  EXPECT_GT(beyond, 20 / kFewer);
}

}  // namespace
}  // namespace misalign::solver
