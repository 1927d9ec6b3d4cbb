// The rejection tests' rules on made-up observations, every margin from both sides.
#include "solver/model/rejection_test.hpp"

#include <cmath>
#include <limits>

#include "tests/solver/blocks.hpp"

namespace misalign::solver {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// As RejectionTolerances has it, per radian.
constexpr double kLeastSlope_widths_per_rad = 1e-5 / kRadPerDeg;

// Newton's own sequence e' = K e^2 in one unknown: its corrections are e - e'. The error left must
// not be more than what is said, whatever K is.
TEST(NewtonError, BoundsWhatIsLeftOfAQuadraticSequence) {
  for (const double constant : {1e-3, 0.1, 1.0, 30.0}) {
    for (double share = 1e-6; share < 0.19; share *= 1.7) {
      const double e0 = share / constant, e1 = share * e0, e2 = constant * e1 * e1;
      const double first = e0 - e1, second = e1 - e2;
      const auto error = newton_error(first, second, 7);
      ASSERT_TRUE(error) << "ratio " << second / first;
      EXPECT_GE(*error, 7 * e2);
      // Not by so much that nothing would ever be rejected: ten times, and what the ratio adds.
      EXPECT_LE(*error, 7 * 10 * 1.5 * e2);
    }
  }
}

TEST(NewtonError, IsKnownBelowAQuarterOnly) {
  EXPECT_TRUE(newton_error(0.1, 0.999 * 0.025, 1));
  EXPECT_FALSE(newton_error(0.1, 1.001 * 0.025, 1));
  EXPECT_FALSE(newton_error(0.01, 0.1, 1));
  EXPECT_FALSE(newton_error(0, 0, 1));
  EXPECT_FALSE(newton_error(kNan, 0.1, 1));
  EXPECT_FALSE(newton_error(0.1, kNan, 1));
}

// Parabolas and sines through their top: between two points, whichever way they were run through,
// the top is no higher than said, and not much is added to it.
TEST(Farthest, BoundsAPilotThatTurnsBack) {
  for (const double from : {-1.0, -0.5, -0.1}) {
    for (const double to : {0.1, 0.5, 1.0}) {
      const double step = to - from;
      const double bow =
          farthest_between(160 - 3 * from * from, -6 * from, 160 - 3 * to * to, -6 * to, step);
      EXPECT_GE(bow, 160);
      // The parabola's tangents meet over the middle, a quarter of the squared step above it.
      const double end = 160 - 3 * std::pow(std::min(-from, to), 2);
      const double meet = 160 + 3 * step * step / 4 - 3 * std::pow((from + to) / 2, 2);
      EXPECT_LE(bow, meet + (meet - end) / 2 + 1e-9);
      EXPECT_GE(farthest_between(160 * std::cos(from), -160 * std::sin(from), 160 * std::cos(to),
                                 -160 * std::sin(to), step),
                160);
    }
  }
  EXPECT_EQ(farthest_between(150, 1, 152, 0.9, 2), 152) << "still on its way";
}

// Two sheets of four diagonals: what is said of the second must not touch the first.
class RejectionRules : public testing::Test {
 protected:
  static constexpr int kThreshold = 150, kSheet = 1;

  RejectionRules() { begin(rejection_); }

  void begin(RejectionTest& rejection) {
    rejection.begin(2);
    for (const int sheet : {0, kSheet}) rejection.set_flat(sheet, flat_.data());
  }
  /// Diagonal 2 longer than flat by `by`, with this slope; the others do not move.
  bool rejects(RejectionTest& rejection, int sample, double by, double slope = 0,
               double length_error = 0, double slope_error = 0) {
    std::array<double, 4> lengths = flat_, slopes = {};
    lengths[2] += by;
    slopes[2] = slope;
    rejection.observe(kSheet, {sample * sample_deg_, is_exact_ ? sample : 0, 1, 0, lengths.data(),
                               length_error, slopes.data(), slope_error});
    EXPECT_FALSE(rejection.decided(0));
    if (rejection.decided(kSheet)) {
      EXPECT_EQ(words(rejection.results()[kSheet]),
                "not_monotone at sample " + std::to_string(sample));
    }
    return rejection.decided(kSheet);
  }
  bool rejects(int sample, double by, double slope = 0, double length_error = 0,
               double slope_error = 0) {
    return rejects(rejection_, sample, by, slope, length_error, slope_error);
  }

  DrawableSheet sheets_{4, 4};
  Model model_{sheets_.base, sheets_.shifted_vertices, {}, kThreshold};
  // Powers of two, so that small differences are exact to 1e-16.
  std::array<double, 4> flat_ = {1, 1, 1, 1};
  // What all steps up to the threshold may hide.
  const double band_ = kStepBand_widths * kThreshold;
  RejectionTest rejection_{model_};
  double sample_deg_ = 1;
  bool is_exact_ = false;
};

TEST_F(RejectionRules, GrownThenShrunkIsRejected) {
  EXPECT_FALSE(rejects(100, 1e-3));
  EXPECT_TRUE(rejects(140, 0.9e-3));
}

TEST_F(RejectionRules, ShrunkThenGrownIsRejectedInAnyOrderOfLooking) {
  EXPECT_FALSE(rejects(140, -1e-3));
  EXPECT_TRUE(rejects(30, -2e-3));  // shorter than later: it has grown since
}

TEST_F(RejectionRules, OneDirectionIsNotRejected) {
  EXPECT_FALSE(rejects(140, 3e-3, 1e-2));
  EXPECT_FALSE(rejects(30, 1e-3, 1e-2));
  EXPECT_FALSE(rejects(145, 4e-3, 1e-2));
  EXPECT_EQ(words(rejection_.results()[kSheet]), "none at sample 0");
}

TEST_F(RejectionRules, NoiseIsNotRejected) {
  for (const double noise : {0.9, -0.9, 0.5, -0.7}) {
    EXPECT_FALSE(rejects(10, noise * 0.5 * band_));
    EXPECT_FALSE(rejects(20, noise * 1e-8, 0, 2e-8));
    EXPECT_FALSE(rejects(30, 0, noise * kLeastSlope_widths_per_rad));
    EXPECT_FALSE(rejects(40, 0, noise * 1e-2, 0, 1e-2));
  }
  EXPECT_FALSE(rejects(50, 1e-3));
  EXPECT_FALSE(rejects(60, 1e-3 - 0.9 * band_));
}

// From flat, and from what was seen before: with the band of every step, and the errors of both.
TEST_F(RejectionRules, StepBandFromBothSides) {
  for (const double error : {0.0, 1e-9}) {
    SCOPED_TRACE(error);
    const double margin = error + band_;
    for (const double by : {0.98 * margin, 1.02 * margin}) {
      begin(rejection_);
      EXPECT_FALSE(rejects(30, -by, 0, error));  // shorter than flat, if that is certain ...
      EXPECT_EQ(rejects(30, 1e-3, 0, error), by > margin);  // ... and the same sample: longer
      begin(rejection_);
      EXPECT_FALSE(rejects(30, 1e-3, 0, error));
      EXPECT_EQ(rejects(60, 1e-3 - by - error, 0, error), by > margin);
      begin(rejection_);
      EXPECT_FALSE(rejects(60, 1e-3, 0, error));
      EXPECT_EQ(rejects(30, 1e-3 + by + error, 0, error), by > margin);
    }
  }
}

// The band is that of every step up to the threshold, wherever the test looks.
TEST_F(RejectionRules, StepBandGrowsWithTheThreshold) {
  for (const int threshold : {20, 180}) {
    const Model model = sheets_.with_threshold(threshold);
    RejectionTest rejection(model);
    for (const double by : {0.98, 1.02}) {
      begin(rejection);
      EXPECT_FALSE(rejects(rejection, 5, 1e-3));
      EXPECT_EQ(rejects(rejection, 6, 1e-3 - by * threshold * kStepBand_widths), by > 1);
    }
  }
}

// Two looks at one sample are one: their lengths are not compared with each other.
TEST_F(RejectionRules, EqualSamplesAreOne) {
  EXPECT_FALSE(rejects(30, 1e-3));
  EXPECT_FALSE(rejects(30, 0.9e-3));
  EXPECT_TRUE(rejects(31, 0.8e-3));
}

TEST_F(RejectionRules, SlopeMarginFromBothSides) {
  for (const double error : {0.0, 1e-2}) {
    for (const double share : {0.999, 1.001}) {
      begin(rejection_);
      EXPECT_FALSE(rejects(30, 1e-3));
      EXPECT_EQ(rejects(60, 1e-3, -share * (error + kLeastSlope_widths_per_rad), 0, error),
                share > 1);
    }
  }
}

// Next to the threshold a fold limit beyond it may turn a slope round and back again.
TEST_F(RejectionRules, SlopesAreIgnoredNextToTheThreshold) {
  for (const int sample : {kThreshold - 2, kThreshold - 1, kThreshold}) {
    begin(rejection_);
    EXPECT_EQ(rejects(sample, 3e-3, -0.1), sample < kThreshold - 1);
  }
  EXPECT_EQ(last_sample_of_slopes(150, 2), 149);
  EXPECT_EQ(last_sample_of_slopes(30, 5), 29);
  EXPECT_EQ(last_sample_of_slopes(1500, 0.1), 1480);
}

// What is known of the last samples themselves is their lengths: from flat, from one to the next,
// and however steep; between them it is nothing.
TEST_F(RejectionRules, LengthsCountAtTheLastSamplesOnly) {
  for (const bool exact : {false, true}) {
    is_exact_ = exact;
    for (const int sample : {kThreshold - 1, kThreshold}) {
      begin(rejection_);
      EXPECT_FALSE(rejects(100, 1e-3));
      EXPECT_EQ(rejects(sample, -1.02 * band_, 0.1), exact) << "shorter than flat";
      for (const double share : {0.98, 1.02}) {
        begin(rejection_);
        EXPECT_FALSE(rejects(sample - 1, 1e-3, 0.1));
        EXPECT_EQ(rejects(sample, 1e-3 - share * band_, -0.1), exact && share > 1);
      }
    }
  }
  EXPECT_EQ(rejection_.next_sample(100.5), kThreshold - 2);
  EXPECT_EQ(rejection_.next_sample(kThreshold - 2), kThreshold - 1);
  EXPECT_EQ(rejection_.next_sample(kThreshold - 1.5), kThreshold - 1);
  EXPECT_EQ(rejection_.next_sample(kThreshold - 1), kThreshold);
}

TEST_F(RejectionRules, SlopesAreIgnoredForCoarseSamples) {
  for (const double sample_deg : {1.0, 2.0, 2.5, 5.0}) {
    PathPlanOptions path;
    path.sample_deg = sample_deg;
    const Model model = sheets_.with_threshold(30, path);
    RejectionTest rejection(model);
    sample_deg_ = sample_deg;
    begin(rejection);
    EXPECT_EQ(rejects(rejection, 10, 2e-2, -0.1), sample_deg <= 2) << sample_deg;
    begin(rejection);
    EXPECT_FALSE(rejects(rejection, 10, 1e-3));
    EXPECT_TRUE(rejects(rejection, 12, 0.9e-3)) << "lengths count at any sample_deg";
  }
}

// What a diagonal may still do on its way to the next sample is no reason.
TEST_F(RejectionRules, ElongationsCountBeyondASamplesWay) {
  const double way = 0.1 * kRadPerDeg;
  for (const double share : {0.99, 1.01}) {
    begin(rejection_);
    EXPECT_EQ(rejects(60, -share * (band_ + way), 0.1), share > 1) << "shorter, and growing";
  }
}

TEST_F(RejectionRules, WhatIsNoNumberIsNoReason) {
  EXPECT_FALSE(rejects(30, 1e-3));
  EXPECT_FALSE(rejects(60, kNan, kNan));
  EXPECT_FALSE(rejects(90, 0.5, -1, kNan, kNan));
}

TEST_F(RejectionRules, BeginForgets) {
  EXPECT_FALSE(rejects(30, 1e-3));
  begin(rejection_);
  EXPECT_FALSE(rejects(60, -1e-3));
  EXPECT_TRUE(rejects(90, 1e-3));
  begin(rejection_);
  EXPECT_FALSE(rejection_.decided(kSheet));
}

// Beyond the verdict's own band by what a fold angle can be off; one of many creases.
TEST_F(RejectionRules, OverFoldMarginFromBothSides) {
  const double margin_deg = 2e-8 / kRadPerDeg;  // 1e-8 of the half angle's cosine
  for (const double share : {0.99, 1.01}) {
    begin(rejection_);
    FoldState<double> state = sheets_.folded(120);
    const int sign = model_.mechanism().creases[5].assignment;
    state.creases[5] = half_angle_of_deg(sign * (180 + share * (kOverFoldBand_deg + margin_deg)));
    rejection_.observe(kSheet, 120, state);
    EXPECT_EQ(words(rejection_.results()[kSheet]),
              share > 1 ? "over_folded at sample 120" : "none at sample 0");
    EXPECT_FALSE(rejection_.decided(0));
  }
}

TEST_F(RejectionRules, LostSignFromBothSides) {
  for (const double share : {0.99, 1.01}) {
    begin(rejection_);
    FoldState<double> state = sheets_.folded(120);
    state.creases[3].s = -share * 1e-8 * model_.mechanism().creases[3].assignment;
    rejection_.observe(kSheet, 120, state);
    EXPECT_EQ(words(rejection_.results()[kSheet]),
              share > 1 ? "assignment_flipped at sample 120" : "none at sample 0");
  }
}

TEST_F(RejectionRules, LimitMarginFromBothSides) {
  const double margin_deg = kRejection.certain_limit_deg;
  for (const double below_deg : {0.0, margin_deg - 1e-9, margin_deg + 1e-9, 20.5}) {
    begin(rejection_);
    EXPECT_FALSE(rejection_.observe(
        kSheet, {100, 0, -0.1, kThreshold - below_deg, flat_.data(), 0, flat_.data(), 0}));
    EXPECT_EQ(words(rejection_.results()[kSheet]),
              below_deg > margin_deg ? "fold_limit at sample 100" : "none at sample 0");
  }
}

// Single precision made -2.4 of 1.2, with slopes off by 2 (8 x 6, shifts of 8 mm).
TEST_F(RejectionRules, APilotTurnsBackForCertainOnly) {
  for (const double slope_error : {0.0099, 0.0101}) {
    begin(rejection_);
    EXPECT_FALSE(rejection_.observe(
        kSheet, {100, 0, -0.1, 100, flat_.data(), 0, flat_.data(), slope_error}));
    EXPECT_EQ(rejection_.results()[kSheet].fault,
              slope_error < 0.01 ? Fault::fold_limit : Fault::none);
  }
}

// A length between two samples is left what its slope, known only so well, may still do.
TEST_F(RejectionRules, LengthsAllowForTheErrorOfSlopes) {
  for (const double slope_error : {0.0, 0.1}) {
    begin(rejection_);
    EXPECT_FALSE(rejects(80, 1e-3));
    EXPECT_EQ(rejects(100, -1.02 * band_, 0, 0, slope_error), slope_error == 0);
  }
}

TEST_F(RejectionRules, APilotThatGoesOnIsNoReason) {
  for (const double rate : {0.1, kNan}) {
    begin(rejection_);
    EXPECT_EQ(rejection_.observe(kSheet, {100, 0, rate, 0, flat_.data(), 0, flat_.data(), 1e3}),
              rate > 0);
    EXPECT_FALSE(rejection_.decided(kSheet));
  }
}

}  // namespace
}  // namespace misalign::solver
