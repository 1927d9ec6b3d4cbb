// Fast tests and full paths together accept exactly what the reference accepts, at any threshold.
#include <set>

#include "solver/lanes/lane_batch.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

class Acceptance : public testing::TestWithParam<DrawnSheets> {};

// The threshold at every sheet's own D, where it must get through, and one beyond, where it must
// not; and all the others at the same thresholds. Every instruction set turns away the same sheets
// at the same angle.
TEST_P(Acceptance, IsTheReferences) {
  const DrawableSheet sheets(GetParam().rows, GetParam().columns, GetParam().shifted);
  const ShiftBlock block = sheets.draws(GetParam().draws / kFewer, kSeed);
  const PathPlan plan = sheets.plan();
  Reference reference(sheets.mechanism, plan);
  const Model any_threshold = sheets.with_threshold(180);
  const auto judging = make_batch(available_instruction_sets().back(), any_threshold);
  const std::vector<Verdict> judged = judging->judge(block);
  std::vector<int> deploys_from;
  std::set<int> thresholds = {20, 40, 60, 80, 100, 120, 140, 160, 180};
  for (int i = 0; i < block.sheets; ++i) {
    const Verdict verdict = reference.judge(sheets.vertices(block, i));
    ASSERT_NE(verdict.first_fault, Fault::undecided);
    deploys_from.push_back(verdict.deploys_from_sample);
    if (deploys_from[i] > 0) thresholds.insert(deploys_from[i]);
    if (deploys_from[i] < 180) thresholds.insert(deploys_from[i] + 1);
  }
  int to_reject = 0, rejected = 0;
  for (const int threshold : thresholds) {
    SCOPED_TRACE("threshold " + std::to_string(threshold));
    // With tables now and then, and once under sanitizers, where they take half a minute to make.
    const bool with_tables = threshold % (kFewer == 1 ? 40 : 120) == 0;
    const Model model = sheets.with_threshold(threshold, {}, with_tables ? 0.4 : 0);
    const auto are_right = [&](const std::vector<Rejection>& rejections) {
      for (int i = 0; i < block.sheets; ++i) {
        const bool passes = rejections[i].fault == Fault::none;
        EXPECT_EQ(passes && judged[i].deploys_from_sample >= threshold,
                  deploys_from[i] >= threshold)
            << "seed " << kSeed << ", sheet " << i << ", D " << deploys_from[i] << ", judged "
            << words(judged[i]) << ", rejections out: " << words(rejections[i]);
        EXPECT_LE(rejections[i].sample, threshold);
        to_reject += deploys_from[i] < threshold;
        rejected += !passes;
      }
    };
    LaneBatch<double, float> scalar(model);
    are_right(scalar.reject(block));
    for (const InstructionSet set : available_instruction_sets()) {
      SCOPED_TRACE(instruction_set_name(set));
      const auto batch = make_batch(set, model);
      are_right(batch->reject(block));
      // With tables in bytes some sheets are turned away elsewhere.
      if (with_tables && set == InstructionSet::avx512) continue;
      EXPECT_EQ(words(batch->reject(block)), words(scalar.reject(block)));
    }
  }
  // Nearly all that is to be rejected is (98 to 100 of 100; 90 among the few draws of a sanitizer);
  // the rest is left to the full path.
  EXPECT_GE(rejected, 0.85 * to_reject);
  RecordProperty("rejected_of_those_to_reject", std::to_string(1.0 * rejected / to_reject));
}

INSTANTIATE_TEST_SUITE_P(Drawn, Acceptance,
                         testing::Values(DrawnSheets{4, 4, Shifted::interior, 100},
                                         DrawnSheets{6, 6, Shifted::interior, 80},
                                         DrawnSheets{6, 6, Shifted::ring, 120}));
INSTANTIATE_TEST_SUITE_P(DrawnSlow, Acceptance,
                         testing::Values(DrawnSheets{8, 6, Shifted::interior, 30}));

}  // namespace
}  // namespace misalign::solver
