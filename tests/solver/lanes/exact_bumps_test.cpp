// BumpRule::exact: by functions, in close steps and by dense matrices the same, and what solves in
// steps of 0.02 degrees say.
#include "solver/lanes/lane_batch.hpp"
#include "tests/solver/blocks.hpp"
#include "tests/solver/finely_judged.hpp"

namespace misalign::solver {
namespace {

struct ExactDraws {
  int rows, columns, draws;
  double sample_deg;
};
void PrintTo(const ExactDraws& d, std::ostream* out) {
  *out << d.rows << "x" << d.columns << " every " << d.sample_deg;
}

class ExactBumps : public testing::TestWithParam<ExactDraws> {
 protected:
  const DrawableSheet sheets_{GetParam().rows, GetParam().columns};
  const ShiftBlock block_ = sheets_.draws(GetParam().draws / kFewer + 1, kSeed + 9);
  const PathPlanOptions path_{.sample_deg = GetParam().sample_deg};
  const Model exact_{sheets_.base, sheets_.shifted_vertices, path_, 0, {BumpRule::exact}};
};

INSTANTIATE_TEST_SUITE_P(Draws, ExactBumps,
                         testing::Values(ExactDraws{4, 4, 30, 1}, ExactDraws{4, 4, 30, 10},
                                         ExactDraws{6, 6, 40, 1}, ExactDraws{6, 6, 16, 5},
                                         ExactDraws{6, 6, 16, 10}));

TEST_P(ExactBumps, AreThoseOfFineStepsSlow) {
  LaneBatch<double, float> batch(exact_);
  const std::vector<Verdict>& verdicts = batch.judge(block_);
  int bumps = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    SCOPED_TRACE(i);
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const FineVerdict fine = judge_finely(sheets_.base, path_, 0.02, vertices_mm);
    const Verdict close = record_history(exact_, vertices_mm).verdict;
    for (const Verdict& verdict : {verdicts[i], close}) {
      EXPECT_EQ(verdict.deploys_from_sample, fine.exact().deploys_from_sample);
      EXPECT_EQ(verdict.first_fault, fine.exact().first_fault);
      EXPECT_EQ(verdict.where, fine.exact().where);
    }
    bumps += fine.bump_sample > 0;
    // What has turned round the samples alone show one later, unless something else comes before.
    const bool is_shown = path_.sample_deg == 1 && fine.samples.first_fault == Fault::not_monotone;
    if (verdicts[i].first_fault != Fault::reverses_between || !is_shown) continue;
    EXPECT_EQ(fine.samples.deploys_from_sample, verdicts[i].deploys_from_sample + 1);
  }
  // By functions: close steps take some 350 iterations to 180 degrees. More sheets of 4 x 4 get
  // there.
  const double iterations = static_cast<double>(batch.path_effort().iterations);
  EXPECT_LT(iterations / block_.sheets, 100);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(bumps, 0);
#endif
}

// The same of the records that candidates are measured by, on every instruction set.
TEST_P(ExactBumps, AreTheSameInRecordsAndRegisters) {
  const Model from_60(sheets_.base, sheets_.shifted_vertices, path_,
                      static_cast<int>(60 / path_.sample_deg), {BumpRule::exact});
  std::vector<Verdict> expected;
  for (const InstructionSet set : available_instruction_sets()) {
    const auto batch = make_batch(set, from_60);
    const std::vector<Verdict> verdicts = batch->judge(block_);
    if (expected.empty()) expected = verdicts;
    const std::vector<PathRecord> records = batch->measure(block_);
    for (int i = 0; i < block_.sheets; ++i) {
      SCOPED_TRACE(std::to_string(i) + " " + instruction_set_name(set));
      EXPECT_EQ(words(verdicts[i]), words(expected[i]));
      EXPECT_EQ(records[i].verdict.deploys_from_sample, expected[i].deploys_from_sample);
      EXPECT_EQ(records[i].verdict.first_fault, expected[i].first_fault);
      EXPECT_EQ(records[i].verdict.where, expected[i].where);
      if (expected[i].deploys_from_sample < from_60.threshold_sample()) continue;
      EXPECT_EQ(records[i].extremes.bump_deg.has_value(), expected[i].first_fault == Fault::bump);
    }
  }
}

// Dense matrices give the samples, solves between them the rest.
TEST_P(ExactBumps, AreTheSameByDenseMatrices) {
  for (int i = 0; i < std::min(block_.sheets, 4); ++i) {
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const Verdict close = record_history(exact_, vertices_mm).verdict;
    const Verdict dense = record_with_pivoting(exact_, vertices_mm).verdict;
    EXPECT_EQ(dense.deploys_from_sample, close.deploys_from_sample) << i;
    EXPECT_EQ(dense.first_fault, close.first_fault) << i;
    EXPECT_EQ(dense.where, close.where) << i;
  }
}

}  // namespace
}  // namespace misalign::solver
