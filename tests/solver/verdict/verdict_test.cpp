// The verdict's rules on made-up samples: every band from both sides, and the order of faults.
#include "solver/verdict/verdict.hpp"

#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

class JudgeTest : public testing::Test {
 protected:
  JudgeTest() : judge_(sheet_.mechanism), lengths_(sheet_.mechanism.diagonals.size(), 1.0) {
    judge_.begin(lengths_);
    for (double& slope : slopes_) slope = 1e-4;
  }

  // The next sample in order: base folding, every diagonal growing by its slope.
  bool step() {
    for (std::size_t d = 0; d < lengths_.size(); ++d) lengths_[d] += slopes_[d];
    return see();
  }
  bool see() { return judge_.see(station(++sample_), &state_, lengths_); }
  static Station station(int sample) {
    return {1.0 * sample, half_angle_of_deg(sample), sample, true};
  }
  Verdict conclude(PathEnd end = PathEnd::end_reached) {
    return judge_.conclude({end, 0, 0, 0, 0});
  }

  TestSheet sheet_{4, 4};
  Judge judge_;
  FoldState<double> state_ = sheet_.folded(30);
  std::vector<double> lengths_;
  std::array<double, 4> slopes_{};
  int sample_ = 0;
};

TEST_F(JudgeTest, MonotoneToTheEndDeploysFromTheEnd) {
  slopes_[2] = -1e-4;
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(step());
  EXPECT_EQ(conclude().deploys_from_sample, 10);
  EXPECT_EQ(conclude().first_fault, Fault::none);
  EXPECT_EQ(conclude().fault_sample(), 0);
}

TEST_F(JudgeTest, StepBackIsAFaultAtTheBandAndNotBelow) {
  for (int k = 0; k < 6; ++k) step();
  lengths_[1] -= 0.5 * kStepBand_widths;
  EXPECT_TRUE(see());
  lengths_[1] -= 2 * kStepBand_widths;
  EXPECT_FALSE(see());
  const Verdict verdict = conclude(PathEnd::stopped);
  EXPECT_EQ(verdict.first_fault, Fault::not_monotone);
  EXPECT_EQ(verdict.deploys_from_sample, 7);
  EXPECT_EQ(verdict.fault_sample(), 8);
  EXPECT_EQ(verdict.where, 1);
}

// What goes back before the next sample has turned round if it still goes back there; otherwise no
// sample shows it, and that is a bump.
TEST_F(JudgeTest, GoingBackBetweenSamplesIsOneOfTwoFaults) {
  slopes_[2] = -1e-4;
  for (const auto& [where, rate, fault] :
       {std::tuple(1, -1e-9, Fault::reverses_between), std::tuple(1, 1e-9, Fault::bump),
        std::tuple(1, 0.0, Fault::bump), std::tuple(2, 1e-9, Fault::reverses_between),
        std::tuple(2, -1e-9, Fault::bump)}) {
    judge_.begin(lengths_);
    sample_ = 0;
    for (int k = 0; k < 6; ++k) step();
    judge_.end_between(where, rate, 6.5);
    const Verdict verdict = conclude(PathEnd::stopped);
    EXPECT_EQ(verdict.first_fault, fault);
    EXPECT_EQ(verdict.deploys_from_sample, 6);
    EXPECT_EQ(verdict.where, where);
    EXPECT_EQ(judge_.between().bump_where, fault == Fault::bump ? where : -1);
    EXPECT_EQ(judge_.between().bump_deg, fault == Fault::bump ? 6.5 : 0);
  }
}

TEST_F(JudgeTest, StepBelowTheBandSetsNoDirection) {
  slopes_[3] = 0;
  lengths_[3] += 0.5 * kStepBand_widths;
  EXPECT_TRUE(step());
  slopes_[3] = -1e-4;
  for (int k = 0; k < 9; ++k) EXPECT_TRUE(step());
  EXPECT_EQ(conclude().first_fault, Fault::none);
}

TEST_F(JudgeTest, LargestStepBackIsNamed) {
  step();
  lengths_[0] -= 1e-6;
  lengths_[2] -= 3e-6;
  lengths_[3] -= 2e-6;
  EXPECT_FALSE(see());
  EXPECT_EQ(conclude().where, 2);
}

TEST_F(JudgeTest, InactiveOnBothSidesOfItsBandAndOfFiveDegrees) {
  slopes_[0] = 0.9 * kInactiveBand_widths / 10;
  for (int k = 0; k < 10; ++k) step();
  EXPECT_EQ(conclude().first_fault, Fault::inactive_diagonal);
  EXPECT_EQ(conclude().deploys_from_sample, 0);
  EXPECT_EQ(conclude().where, 0);
  slopes_[0] = 0.3 * kInactiveBand_widths;
  step();
  EXPECT_EQ(conclude().first_fault, Fault::none);
  EXPECT_EQ(conclude().deploys_from_sample, 11);
}

// What stands still drives nothing, wherever the path is lost.
TEST_F(JudgeTest, InactivityComesBeforeAFailureThatLeavesUndecided) {
  slopes_[1] = 0;
  for (int k = 0; k < 4; ++k) step();
  EXPECT_EQ(conclude(PathEnd::stalled).first_fault, Fault::undecided);
  for (int k = 0; k < 2; ++k) step();
  EXPECT_EQ(conclude(PathEnd::stalled).first_fault, Fault::inactive_diagonal);
  EXPECT_EQ(conclude(PathEnd::stalled).deploys_from_sample, 0);
  EXPECT_EQ(conclude(PathEnd::stalled).where, 1);
  judge_.end(Fault::undecided, -1);
  EXPECT_EQ(conclude(PathEnd::stopped).first_fault, Fault::inactive_diagonal);
}

TEST_F(JudgeTest, NothingIsCalledInactiveBelowFiveDegrees) {
  slopes_[0] = 0;
  for (int k = 0; k < 4; ++k) step();
  EXPECT_EQ(conclude(PathEnd::fold_limit).first_fault, Fault::fold_limit);
  EXPECT_EQ(conclude(PathEnd::fold_limit).deploys_from_sample, 4);
  step();
  EXPECT_EQ(conclude(PathEnd::fold_limit).first_fault, Fault::inactive_diagonal);
}

TEST_F(JudgeTest, OverFoldedOnBothSidesOfItsBand) {
  const int sign = sheet_.mechanism.creases[5].assignment;
  state_.creases[5] = half_angle_of_deg(sign * (180 + 0.5 * kOverFoldBand_deg));
  EXPECT_TRUE(step());
  state_.creases[5] = half_angle_of_deg(sign * (180 + 2 * kOverFoldBand_deg));
  EXPECT_FALSE(step());
  EXPECT_EQ(conclude().first_fault, Fault::over_folded);
  EXPECT_EQ(conclude().where, 5);
}

TEST_F(JudgeTest, AssignmentFlippedWhenASignIsLost) {
  state_.creases[3].s *= -1;
  EXPECT_FALSE(step());
  EXPECT_EQ(conclude().first_fault, Fault::assignment_flipped);
  EXPECT_EQ(conclude().where, 3);
  EXPECT_EQ(conclude().deploys_from_sample, 0);
}

TEST_F(JudgeTest, OrderOfFaultsThatMeet) {
  for (int k = 0; k < 6; ++k) step();
  lengths_[0] -= 1;
  state_.creases[2].s *= -1;
  const int sign = sheet_.mechanism.creases[7].assignment;
  state_.creases[7] = half_angle_of_deg(sign * 190);
  EXPECT_FALSE(see());
  EXPECT_EQ(conclude().first_fault, Fault::over_folded);
}

TEST_F(JudgeTest, NumericalFailureIsUndecidedUnlessAFaultCameFirst) {
  for (int k = 0; k < 6; ++k) step();
  EXPECT_EQ(conclude(PathEnd::stalled).first_fault, Fault::undecided);
  EXPECT_EQ(conclude(PathEnd::start_lost).first_fault, Fault::undecided);
  EXPECT_EQ(conclude(PathEnd::fold_limit).first_fault, Fault::fold_limit);
  lengths_[0] -= 1;
  see();
  EXPECT_EQ(conclude(PathEnd::stalled).first_fault, Fault::not_monotone);
}

}  // namespace
}  // namespace misalign::solver
