// BumpRule::exact: by functions, in close steps and by dense matrices the same, and what solves in
// steps of 0.02 degrees say.
#include "finely_judged.hpp"
#include "blocks.hpp"
#include "solver/lanes/lane_batch.hpp"

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
  const Model exact_{sheets_.base, sheets_.shifted_vertices, path_, 0, BumpRule::exact};
};

INSTANTIATE_TEST_SUITE_P(Draws, ExactBumps,
                         testing::Values(ExactDraws{4, 4, 60, 1}, ExactDraws{4, 4, 60, 10},
                                         ExactDraws{6, 6, 40, 1}, ExactDraws{6, 6, 40, 5},
                                         ExactDraws{6, 6, 40, 10}));

TEST_P(ExactBumps, AreThoseOfFineSteps) {
  LaneBatch<double, float> batch(exact_);
  const std::vector<Verdict>& verdicts = batch.judge(block_);
  int bumps = 0;
  for (int i = 0; i < block_.sheets; ++i) {
    SCOPED_TRACE(i);
    const FlatVertices vertices_mm = sheets_.vertices(block_, i);
    const FineVerdict fine = judge_finely(sheets_.base, path_, 0.02, vertices_mm);
    const Verdict close = record_history(exact_, vertices_mm).verdict;
    if (getenv("SHOW"))
      printf("%d: %s | %s | close %s | back %g\n", i, words(verdicts[i]).c_str(),
             words(fine.exact()).c_str(), words(close).c_str(), fine.bump_back);
    for (const Verdict& verdict : {verdicts[i], close}) {
      EXPECT_EQ(verdict.deploys_from_sample, fine.exact().deploys_from_sample);
      EXPECT_EQ(verdict.first_fault, fine.exact().first_fault);
      EXPECT_EQ(verdict.where, fine.exact().where);
    }
    bumps += fine.bump_sample > 0;
  }
  printf("bumps %d; iterations a sheet %.1f\n", bumps, static_cast<double>(batch.path_effort().iterations) / block_.sheets);
  EXPECT_GT(bumps, 0);
}

}  // namespace
}  // namespace misalign::solver
