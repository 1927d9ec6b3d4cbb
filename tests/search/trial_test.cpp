#include "search/trial.hpp"

#include <gtest/gtest.h>

namespace misalign::search {
namespace {

schema::Campaign small_campaign() {
  return schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                                {"accept", {{"deploys_from_deg", 150}}}},
                               "a test");
}

// The accepted pattern's metrics belong to the verdict, and do not depend on what ran before.
TEST(Trial, CandidatesAreWhatTheirDrawsGive) {
  Trial trial(small_campaign());
  int accepted = 0;
  for (std::uint64_t draw = 0; draw < 60; ++draw) {
    const Outcome outcome = trial.run(draw);
    EXPECT_EQ(outcome.candidate.has_value(), outcome.verdict.deploys_from_sample >= 150);
    if (!outcome.candidate) continue;
    ++accepted;
    const solver::Metrics& m = outcome.candidate->metrics;
    EXPECT_EQ(m.deploys_from_sample, outcome.verdict.deploys_from_sample);
    EXPECT_EQ(m.increasing + m.decreasing, 4);
    EXPECT_GE(m.fold_limit_deg, m.deploys_from_deg);
    EXPECT_LE(m.stroke_min, m.stroke_max);
    EXPECT_EQ(m.stroke_max, std::max(m.elongation_max, -m.elongation_min));
    EXPECT_GT(*m.slope_min_mm_per_deg, 0);
    EXPECT_LE(m.isometry_error_mm, 1e-9);
    EXPECT_LE(m.residual_max, 1e-12);

    Trial fresh(small_campaign());
    const Outcome again = fresh.run(draw);
    EXPECT_EQ(again.candidate->metrics.stretch_sq_mm2, m.stretch_sq_mm2);
    EXPECT_EQ(again.candidate->shifts_mm, outcome.candidate->shifts_mm);
  }
  EXPECT_GT(accepted, 10);
}

// Metrics again from the history, by loops of their own.
TEST(Trial, MetricsFromTheHistory) {
  Trial trial(small_campaign());
  std::uint64_t draw = 0;
  Outcome outcome = trial.run(draw);
  while (!outcome.candidate) outcome = trial.run(++draw);
  const solver::Metrics& m = outcome.candidate->metrics;
  const auto history = trial.history(draw);
  const Eigen::Index d_samples = m.deploys_from_sample;
  const Eigen::Map<const Eigen::RowVectorXd> flat(history.flat_mm.data(), 4);
  const Eigen::MatrixXd lengths = history.length_mm.topRows(d_samples);
  const Eigen::MatrixXd stretch = lengths.rowwise() - flat;
  const Eigen::MatrixXd elongation = stretch.array().rowwise() / flat.array();
  EXPECT_NEAR(m.elongation_max, std::max(0.0, elongation.maxCoeff()), 1e-15);
  EXPECT_NEAR(m.elongation_min, std::min(0.0, elongation.minCoeff()), 1e-15);
  EXPECT_NEAR(m.stretch_sq_mm2, stretch.bottomRows(1).squaredNorm(), 1e-12 * m.stretch_sq_mm2);
  const Eigen::MatrixXd slopes =
      (lengths.bottomRows(d_samples - 4) - lengths.middleRows(3, d_samples - 4)).cwiseAbs();
  EXPECT_NEAR(*m.slope_min_mm_per_deg, slopes.minCoeff(), 1e-15);
  EXPECT_NEAR(m.stroke_min, elongation.cwiseAbs().colwise().maxCoeff().minCoeff(), 1e-15);
  EXPECT_EQ(m.increasing, (stretch.bottomRows(1).array() > 0).count());
}

TEST(Trial, UnitsCountEveryDrawOnce) {
  Trial trial(small_campaign());
  UnitWork work(trial, {1000, 1040});
  for (int k = 0; k < 30; ++k) work.run_next_draw();
  EXPECT_FALSE(work.finished());
  const schema::UnitRecord unit = work.take();
  EXPECT_EQ(unit.range, (schema::DrawRange{1000, 1030}));
  EXPECT_EQ(unit.accepted + unit.rejected + unit.undecided.size(), 30u);
  EXPECT_EQ(unit.accepted, unit.candidates.size());
  ASSERT_EQ(unit.fault_sample.size(), 1u);
  EXPECT_EQ(unit.fault_sample[0].draw, 1024u);
  std::uint64_t screened = 0;
  for (const auto& [seen, draws] : unit.screened) screened += draws;
  EXPECT_EQ(screened, unit.rejected);
}

}  // namespace
}  // namespace misalign::search
