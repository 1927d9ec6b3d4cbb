// Close steps along the arc of a curve that is known: the pilot as a parabola over one other
// unknown, with a top, a forward half and a backward half. The test is its corrector.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "solver/continuation/close_steps.hpp"
#include "tests/solver/continuation/usual_steps.hpp"

namespace misalign::solver {
namespace {

constexpr CloseSteps::ArcOptions kArc;

/// pilot = top - curvature / 2 u^2, everything in rad; forward is u < 0.
struct Parabola {
  double top_deg, curvature;

  double pilot(double u) const { return top_deg * kRadPerDeg - 0.5 * curvature * u * u; }
  double forward_at(double pilot_deg) const {
    return -std::sqrt(2 * (top_deg - pilot_deg) * kRadPerDeg / curvature);
  }
  double slope(double u) const { return -curvature * u; }
  double tangent_u(double u) const { return 1 / std::hypot(1.0, slope(u)); }
  double tangent_pilot(double u) const { return slope(u) * tangent_u(u); }
};

PathStart arc_start(const PathPlan& plan, int forward_sign = 0) {
  return {nullptr, nullptr, &plan, 0, forward_sign};
}

/// How far a step goes along the newest node's tangent, and nothing else.
double along(const PathStep& step, const CloseSteps& control) {
  const int newest = control.newest() % kStatePlaces;
  for (int place = 0; place < kStatePlaces; ++place) {
    EXPECT_EQ(step.of_values[place], place == newest ? 1 : 0);
    EXPECT_TRUE(place == newest || step.of_rates[place] == 0);
  }
  return step.of_rates[newest];
}

HalfAngle<double> half_angle_of_rad(double angle) {
  return {std::cos(0.5 * angle), std::sin(0.5 * angle)};
}

/// Makes the steps of a control on a parabola, as a path follower would with exact arithmetic.
class ArcWalker {
 public:
  ArcWalker(const Parabola& curve, const CloseSteps::Options& options = kUsual)
      : curve_(curve), control_(options) {}

  const PathResult& result() const { return control_.result(); }
  double last() const { return last_; }
  double below_top_deg() const { return curve_.top_deg - curve_.pilot(last_) / kRadPerDeg; }
  double longest_step() const { return longest_step_; }
  int tries_beyond_top() const { return tries_beyond_top_; }
  int tries_ahead() const { return tries_ahead_; }

  /// A station beyond the top has a solution straight ahead.
  void close_ahead() { closes_ahead_ = true; }
  /// A station beyond the top has a solution, which Newton finds this far (rad) from the top.
  void close_beyond_top(double away) { closes_at_ = away; }

  /// From 10 degrees to where the path ends, or the last station.
  void follow(const PathPlan& plan) {
    last_ = trial_ = curve_.forward_at(plan.stations[0].pilot_deg);
    control_.begin(arc_start(plan, +1));
    PathStep move = control_.after(reading());
    while (!move.ended) {
      if (move.keep) last_ = trial_;
      if (move.arrived) {
        move = control_.proceed();
        // No solution there, or too far for Newton with the pilot held: it says so.
        if (!move.ended) move = control_.after(lost());
      } else {
        move = control_.after(depart(move));
      }
    }
    if (move.keep) last_ = trial_;
  }

 private:
  NewtonReport depart(const PathStep& move) {
    EXPECT_TRUE(move.depart);
    if (move.hold) {
      EXPECT_FALSE(control_.is_free());
      if (control_.target().pilot_deg > curve_.top_deg) return beyond_top(move);
      trial_ = curve_.forward_at(control_.target().pilot_deg);
    } else {
      EXPECT_TRUE(control_.is_free());
      longest_step_ = std::max(longest_step_, along(move, control_));
      trial_ = last_ + along(move, control_) * curve_.tangent_u(last_);
    }
    return reading();
  }
  // Tangents come out with either sign; the bordered determinant takes theirs.
  NewtonReport reading() {
    const int sign = (++readings_ % 3 == 0) ? -1 : 1;
    const double cosine = curve_.tangent_u(last_) * curve_.tangent_u(trial_) +
                          curve_.tangent_pilot(last_) * curve_.tangent_pilot(trial_);
    return {0,
            0,
            sign,
            sign * curve_.tangent_pilot(trial_),
            sign * cosine,
            half_angle_of_rad(curve_.pilot(trial_)),
            std::abs(std::sin(0.5 * (trial_ - last_)))};
  }
  NewtonReport beyond_top(const PathStep& move) {
    const bool is_ahead = move.of_values[control_.newest() % kStatePlaces] == 0;
    if (is_ahead) ++tries_ahead_;
    if (is_ahead && !closes_ahead_) return lost();
    if (is_ahead) {
      trial_ = 0;
      return reading();
    }
    ++tries_beyond_top_;
    EXPECT_EQ(along(move, control_), 0) << "from the last point believed";
    trial_ = closes_at_.value_or(0);
    return closes_at_ ? reading() : lost();
  }
  NewtonReport lost() {
    NewtonReport reading = this->reading();
    reading.open_by = std::nan("");
    return reading;
  }

  Parabola curve_;
  CloseSteps control_;
  double last_ = 0, trial_ = 0, longest_step_ = 0;
  int readings_ = 0, tries_beyond_top_ = 0, tries_ahead_ = 0;
  bool closes_ahead_ = false;
  std::optional<double> closes_at_;
};

// Tops of every height over the last station and of every width, with the tolerance of full paths
// and with a wide one. The rest of the error is that of angles in degrees, 1e-13.
TEST(Arc, FoldLimitIsTheParabolasTop) {
  const PathPlan plan = stations_at({10, 60});
  for (const double tolerance_deg : {kArc.limit_tolerance_rad / kRadPerDeg, 0.1}) {
    CloseSteps::Options options = kUsual;
    options.arc.limit_tolerance_rad = tolerance_deg * kRadPerDeg;
    double worst = 0;
    for (const double height_deg : {1e-5, 1e-3, 0.1, 1.0, 7.0, 30.0, 49.9}) {
      for (const double curvature : {0.1, 0.5, 2.0, 10.0, 50.0}) {
        SCOPED_TRACE(testing::Message() << height_deg << " degrees, curvature " << curvature);
        ArcWalker arc({10 + height_deg, curvature}, options);
        arc.follow(plan);
        EXPECT_EQ(arc.result().end, PathEnd::fold_limit);
        EXPECT_NEAR(arc.result().fold_limit_deg, 10 + height_deg, tolerance_deg);
        EXPECT_LE(arc.longest_step(), kArc.longest_step_rad);
        EXPECT_LE(arc.last(), 0) << "the last point believed is on the forward half";
        EXPECT_LE(arc.below_top_deg(), tolerance_deg) << "which is why the limit can be trusted";
        worst = std::max(worst, std::abs(arc.result().fold_limit_deg - 10 - height_deg));
      }
    }
    RecordProperty("worst_deg", std::to_string(worst));
  }
}

// Below the top a station is landed on, and the next one reached along the arc again.
TEST(Arc, LandsOnStationsBelowTheTop) {
  for (const double curvature : {0.1, 2.0, 50.0}) {
    ArcWalker reaches({31, curvature});
    reaches.follow(stations_at({10, 20, 30}));
    EXPECT_EQ(reaches.result().end, PathEnd::end_reached);
    EXPECT_EQ(reaches.result().fold_limit_deg, 30);
    EXPECT_EQ(reaches.last(), (Parabola{31, curvature}.forward_at(30)));

    ArcWalker turns({29, curvature});
    turns.follow(stations_at({10, 20, 30}));
    EXPECT_EQ(turns.result().end, PathEnd::fold_limit);
    EXPECT_NEAR(turns.result().fold_limit_deg, 29, 1e-6);
  }
}

// A limit point next to a station may be the station itself, where the equations are singular: it
// is tried once with the pilot held.
TEST(Arc, ALimitPointNextToASingularStation) {
  CloseSteps::Options options = kUsual;
  options.arc.singular_gap_rad = 1e-5 * kRadPerDeg;
  const auto followed = [&](double below_deg, std::optional<double> away) {
    ArcWalker arc({30 - below_deg, 1}, options);
    if (away) arc.close_beyond_top(*away);
    arc.follow(stations_at({10, 30}));
    return arc;
  };
  const ArcWalker reached = followed(0.9e-5, 0), refused = followed(0.9e-5, {});
  EXPECT_EQ(reached.result().end, PathEnd::end_reached);
  EXPECT_EQ(reached.result().fold_limit_deg, 30);
  EXPECT_EQ(refused.result().end, PathEnd::fold_limit);
  EXPECT_NEAR(refused.result().fold_limit_deg, 30 - 0.9e-5, 1e-7);
  ArcWalker ahead({30 - 0.9e-5, 1}, options);
  ahead.close_ahead();
  ahead.follow(stations_at({10, 30}));
  EXPECT_EQ(ahead.result().end, PathEnd::end_reached);
  EXPECT_EQ(ahead.tries_ahead(), 1);
  EXPECT_EQ(ahead.tries_beyond_top(), 0);
  const ArcWalker too_far = followed(1.1e-5, 0);
  EXPECT_EQ(too_far.result().end, PathEnd::fold_limit);
  // sin(half of it) is 0.005, but for the 1e-4 from the last point believed to the top.
  EXPECT_EQ(followed(0.9e-5, 0.0095).result().end, PathEnd::end_reached);
  EXPECT_EQ(followed(0.9e-5, 0.0105).result().end, PathEnd::fold_limit) << "another branch";
  EXPECT_EQ(reached.tries_beyond_top(), 1);
  EXPECT_EQ(refused.tries_beyond_top(), 1);
  EXPECT_EQ(too_far.tries_beyond_top(), 0);
}

// After an arc the rates before it say nothing: the next extrapolation is a straight line.
TEST(Arc, ForgetsTheRatesBeforeIt) {
  const PathPlan plan = stations_at({10, 20, 30, 40});
  const NewtonReport at_10 = {0, 0, 1, 0.25, 1, half_angle_of_deg(10)};
  CloseSteps control(kUsual);
  control.begin(arc_start(plan));
  control.after(at_10);
  control.proceed();
  NewtonReport reading = at_10;
  reading.pilot = half_angle_of_deg(20);
  control.after(reading);
  EXPECT_NE(control.proceed().of_rates[0], 0);
  reading.open_by = std::nan("");
  control.after(reading);
  ASSERT_TRUE(control.is_free());
  reading.open_by = 0;
  reading.pilot = half_angle_of_deg(30.5);
  const PathStep landing = control.after(reading);
  EXPECT_TRUE(landing.hold);
  // 10 of the 10.5 degrees; of half angles' sines, to a part in a thousand.
  EXPECT_NEAR(along(landing, control), kArc.longest_step_rad * 10 / 10.5,
              1e-3 * kArc.longest_step_rad);
  reading.pilot = half_angle_of_deg(30);
  EXPECT_TRUE(control.after(reading).arrived);
  const PathStep next = control.proceed();
  EXPECT_NEAR(along(next, control), 10 * kRadPerDeg / 0.25, 1e-15);
}

class ArcStepTest : public testing::Test {
 protected:
  ArcStepTest() {
    control_.begin(arc_start(plan_));
    NewtonReport first = on_curve_;
    first.pilot = half_angle_of_deg(10);
    control_.after(first);
    control_.proceed();
    NewtonReport lost = on_curve_;
    lost.open_by = std::nan("");
    step_ = along(control_.after(lost), control_);
    EXPECT_EQ(step_, kArc.longest_step_rad);
  }
  void expect_half_a_step(const NewtonReport& reading) {
    const PathStep move = control_.after(reading);
    EXPECT_TRUE(move.depart && control_.is_free());
    EXPECT_FALSE(move.keep || move.hold || move.ended);
    step_ *= 0.5;
    EXPECT_EQ(along(move, control_), step_);
  }

  const PathPlan plan_ = stations_at({10, 40});
  CloseSteps control_{kUsual};
  double step_;
  // Found along the arc: 2 degrees on.
  const NewtonReport on_curve_ = {0, 0, 1, 0.25, 1, half_angle_of_deg(12)};
};

TEST_F(ArcStepTest, HalvesWhereTheCorrectorFails) {
  NewtonReport reading = on_curve_;
  reading.open_by = 1e-3;
  control_.after(reading);
  control_.after(reading);
  expect_half_a_step(reading);
  reading.open_by = std::nan("");
  expect_half_a_step(reading);
}

TEST_F(ArcStepTest, HalvesOnAnotherCurve) {
  NewtonReport reading = on_curve_;
  reading.orientation = -1;
  expect_half_a_step(reading);
  reading = on_curve_;
  reading.tangent_cosine = 0.999 * kArc.least_tangent_cosine;
  expect_half_a_step(reading);
  reading.tangent_cosine *= -1;  // the tangent the other way round, orientation not
  expect_half_a_step(reading);
}

TEST_F(ArcStepTest, BelievesAndStretchesWithinTheCosineEitherWayRound) {
  NewtonReport reading = on_curve_;
  reading.tangent_cosine = kArc.least_tangent_cosine;
  PathStep move = control_.after(reading);
  EXPECT_TRUE(move.keep && move.depart);
  EXPECT_EQ(move.tangent_sign, 1);
  EXPECT_EQ(along(move, control_), kArc.longest_step_rad);  // no longer than that

  expect_half_a_step([&] {
    NewtonReport lost = on_curve_;
    lost.open_by = std::nan("");
    return lost;
  }());
  reading.tangent_cosine = -1;
  reading.orientation = -1;
  reading.tangent_pilot = -0.25;
  move = control_.after(reading);
  EXPECT_TRUE(move.keep);
  EXPECT_EQ(move.tangent_sign, -1);
  EXPECT_EQ(along(move, control_), 1.5 * step_);
}

// A landing is believed within the step that led over the station, on the forward half.
TEST_F(ArcStepTest, LandingFromBothSidesOfItsBound) {
  NewtonReport beyond = on_curve_;
  beyond.pilot = half_angle_of_deg(41);
  EXPECT_TRUE(control_.after(beyond).hold);
  NewtonReport landed = on_curve_;
  landed.pilot = half_angle_of_deg(40);
  landed.largest_half_sine = 1.001 * step_;
  expect_half_a_step(landed);

  EXPECT_TRUE(control_.after(beyond).hold);
  landed.largest_half_sine = 0;
  landed.orientation = -1;
  expect_half_a_step(landed);

  EXPECT_TRUE(control_.after(beyond).hold);
  landed.orientation = 1;
  landed.largest_half_sine = step_;
  EXPECT_TRUE(control_.after(landed).arrived);
  EXPECT_EQ(control_.result().fold_limit_deg, 40);
}

// 0.1 rad is below 1e-9 rad after 27 halvings.
TEST_F(ArcStepTest, StallsBelowTheShortestStep) {
  NewtonReport reading = on_curve_;
  reading.open_by = std::nan("");
  for (int k = 1; k < 27; ++k) expect_half_a_step(reading);
  EXPECT_TRUE(control_.after(reading).ended);
  EXPECT_EQ(control_.result().end, PathEnd::stalled);
  EXPECT_NEAR(control_.result().fold_limit_deg, 10, 1e-12);  // how far it came
  EXPECT_FALSE(control_.under_way());
}

TEST_F(ArcStepTest, StallsAfterTooManySteps) {
  for (int k = 1; k < kArc.most_steps; ++k) ASSERT_TRUE(control_.after(on_curve_).keep);
  EXPECT_TRUE(control_.after(on_curve_).ended);
  EXPECT_EQ(control_.result().end, PathEnd::stalled);
  EXPECT_EQ(control_.result().arc_steps, kArc.most_steps + 1);
}

}  // namespace
}  // namespace misalign::solver
