// The course alone, fed with made-up readings: what it believes, when it walks, and where a curve
// that is known in closed form turns.
#include "solver/continuation/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

constexpr CourseOptions kUsual;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

PathPlan plan_of(const std::vector<double>& angles_deg) {
  PathPlan plan;
  for (const double angle_deg : angles_deg) {
    plan.stops.push_back({angle_deg, half_angle_of_deg(angle_deg), 0, true});
  }
  return plan;
}

/// A solution at this pilot, nothing wrong with it.
Reading solution_at(double last_deg, double pilot_deg) {
  return {0.5 * kUsual.closure_tolerance, 1e-8, +1, +1, 0.25, 1, 0.01, half_angle_of_deg(last_deg),
          half_angle_of_deg(pilot_deg)};
}
Reading open_by(double open, Reading reading) {
  reading.open_by = open;
  return reading;
}

bool does_nothing(const Move& move) {
  return !move.believe && !move.arrived && !move.ended && !move.depart && !move.hold;
}

class CourseTest : public testing::Test {
 protected:
  // The course has arrived at 10 degrees and is on its way to 20.
  void arrive_at_first_stop(Course& course) {
    course.begin(plan_, 0, 0);
    EXPECT_TRUE(course.after(solution_at(10, 10)).arrived);
    EXPECT_TRUE(course.proceed().hold);
  }
  // 10 degrees in a first step: half the way to the stop along a tangent of pilot entry 0.25 is
  // more than the longest step.
  void expect_walk_begins(const Course& course, const Move& move) {
    EXPECT_TRUE(course.walking());
    EXPECT_TRUE(move.depart);
    EXPECT_FALSE(move.hold || move.believe || move.arrived || move.ended);
    EXPECT_EQ(move.along[0], kUsual.walk.longest_step_rad);
    EXPECT_EQ(move.along[1], 0);
    EXPECT_EQ(move.along[2], 0);
  }

  const PathPlan plan_ = plan_of({10, 20, 30});
  const Reading at_10_ = solution_at(10, 10), at_20_ = solution_at(10, 20);
};

TEST_F(CourseTest, ConvergedStartArrives) {
  for (const double tangent_pilot : {0.25, -0.25}) {
    Course course;
    course.begin(plan_, 0, 0);
    EXPECT_TRUE(does_nothing(course.after(open_by(1e-3, at_10_))));
    Reading reading = at_10_;
    reading.determinant_sign = -1;
    reading.tangent_pilot = tangent_pilot;
    const Move move = course.after(reading);
    EXPECT_TRUE(move.believe && move.arrived);
    EXPECT_FALSE(move.ended || move.depart);
    EXPECT_EQ(move.tangent_sign, tangent_pilot > 0 ? 1 : -1);  // towards a growing pilot
    EXPECT_EQ(course.forward_sign(), -1);
    EXPECT_EQ(course.result().newton_solves, 1);
    EXPECT_EQ(course.result().newton_iterations, 2);
    EXPECT_EQ(course.result().fold_limit_deg, 10);
  }
}

TEST_F(CourseTest, ClosureToleranceFromBothSides) {
  Course course;
  course.begin(plan_, 0, 0);
  EXPECT_TRUE(does_nothing(course.after(open_by(1.001 * kUsual.closure_tolerance, at_10_))));
  EXPECT_TRUE(course.after(open_by(kUsual.closure_tolerance, at_10_)).arrived);
}

// From the base folding the second correction may open the loops again, the third not.
TEST_F(CourseTest, GrowingResidualAtTheStart) {
  Course course;
  course.begin(plan_, 0, 0);
  for (const double open : {1e-4, 1e-7, 2e-7}) {
    EXPECT_TRUE(does_nothing(course.after(open_by(open, at_10_))));
  }
  EXPECT_TRUE(course.after(open_by(2e-7, at_10_)).ended);
  EXPECT_EQ(course.result().end, PathEnd::start_lost);
}

// Later one that grows in the first iteration may still converge; after that it is lost.
TEST_F(CourseTest, GrowingResidualWalks) {
  Course course;
  arrive_at_first_stop(course);
  EXPECT_TRUE(does_nothing(course.after(open_by(1e-3, at_20_))));
  EXPECT_TRUE(does_nothing(course.after(open_by(1e-2, at_20_))));
  expect_walk_begins(course, course.after(open_by(1e-2, at_20_)));
}

TEST_F(CourseTest, ResidualThatIsNoNumberWalks) {
  for (const double open : {kNan, std::numeric_limits<double>::infinity()}) {
    Course course;
    arrive_at_first_stop(course);
    expect_walk_begins(course, course.after(open_by(open, at_20_)));
  }
}

// A loop may look closed where the largest of many entries is not a number.
TEST_F(CourseTest, TangentThatIsNoNumberIsNeverBelieved) {
  Reading reading = at_10_;
  reading.open_by = 0;
  reading.tangent_pilot = kNan;
  Course course;
  course.begin(plan_, 0, 0);
  EXPECT_TRUE(course.after(reading).ended);
  EXPECT_EQ(course.result().end, PathEnd::start_lost);
  arrive_at_first_stop(course);
  expect_walk_begins(course, course.after(reading));
}

TEST_F(CourseTest, OneCorrectionTooManyWalks) {
  for (const int corrections : {kUsual.max_corrections, kUsual.max_corrections + 1}) {
    Course course;
    arrive_at_first_stop(course);
    for (int k = 0; k < kUsual.max_corrections; ++k) {
      EXPECT_TRUE(does_nothing(course.after(open_by(std::pow(0.5, k), at_20_))));
    }
    if (corrections == kUsual.max_corrections) {
      EXPECT_TRUE(course.after(at_20_).arrived);
    } else {
      expect_walk_begins(course, course.after(open_by(1e-11, at_20_)));
    }
  }
}

TEST_F(CourseTest, ChangedDeterminantSignWalks) {
  Course course;
  arrive_at_first_stop(course);
  Reading reading = at_20_;
  reading.determinant_sign = -1;
  expect_walk_begins(course, course.after(reading));
  EXPECT_EQ(course.forward_sign(), +1);
}

TEST_F(CourseTest, JumpWalksFromItsBoundOn) {
  for (const double half_sine :
       {kUsual.longest_half_sine, 1.001 * kUsual.longest_half_sine, kNan}) {
    Course course;
    arrive_at_first_stop(course);
    Reading reading = at_20_;
    reading.largest_half_sine = half_sine;
    const Move move = course.after(reading);
    if (half_sine == kUsual.longest_half_sine) {
      EXPECT_TRUE(move.arrived);
    } else {
      expect_walk_begins(course, move);
    }
  }
}

// All corrections since departing count together, but not those of the start, which has a bound of
// its own.
TEST_F(CourseTest, LongCorrectionsWalkFromTheirBoundOn) {
  CourseOptions options;
  options.longest_correction_rad = 0.125;
  for (const double second : {0.0625, 0.0626}) {
    Course course(options);
    course.begin(plan_, 0, 0);
    Reading reading = at_10_;
    reading.correction_rad = 0.08;
    EXPECT_TRUE(course.after(reading).arrived);
    course.proceed();
    reading = open_by(1e-3, at_20_);
    reading.correction_rad = 0.0625;
    EXPECT_TRUE(does_nothing(course.after(reading)));
    reading.open_by = 0;
    reading.correction_rad = second;
    const Move move = course.after(reading);
    if (second == 0.0625) {
      EXPECT_TRUE(move.arrived);
    } else {
      expect_walk_begins(course, move);
    }
  }
}

// What lies farther from the base folding than half of the pilot's angle may be another branch.
TEST_F(CourseTest, StartIsLostBeyondHalfOfThePilotsAngle) {
  const double bound_rad = kUsual.longest_start_share * 10 * kRadPerDeg;
  for (const double share : {0.999, 1.001}) {
    Course course;
    course.begin(plan_, 0, 0);
    Reading reading = open_by(1e-3, at_10_);
    reading.correction_rad = 0.5 * bound_rad;
    EXPECT_TRUE(does_nothing(course.after(reading)));
    reading = at_10_;
    reading.correction_rad = (share - 0.5) * bound_rad;
    const Move move = course.after(reading);
    if (share < 1) {
      EXPECT_TRUE(move.arrived);
    } else {
      EXPECT_TRUE(move.ended);
      EXPECT_EQ(course.result().end, PathEnd::start_lost);
    }
  }
}

TEST_F(CourseTest, StartIsLostWhereNothingWasBelievedYet) {
  Reading jump = at_10_, other_half = at_10_;
  jump.largest_half_sine = 0.5;
  other_half.determinant_sign = -1;
  for (const Reading& reading : {open_by(kNan, at_10_), jump, other_half}) {
    Course course;
    course.begin(plan_, 0, +1);
    const Move move = course.after(reading);
    EXPECT_TRUE(move.ended);
    EXPECT_FALSE(move.believe || move.arrived || move.depart);
    EXPECT_EQ(course.result().end, PathEnd::start_lost);
    EXPECT_FALSE(course.under_way());
  }
}

TEST_F(CourseTest, EndsAtTheLastStopOrWhenTheVisitorHasSeenEnough) {
  Course course;
  course.begin(plan_, 1, 0);  // the second of three stops
  EXPECT_TRUE(course.after(solution_at(20, 20)).arrived);
  EXPECT_TRUE(course.proceed().depart);
  EXPECT_TRUE(course.after(solution_at(20, 30)).arrived);
  EXPECT_TRUE(course.proceed().ended);
  EXPECT_EQ(course.result().end, PathEnd::end_reached);
  EXPECT_EQ(course.result().fold_limit_deg, 30);
  EXPECT_FALSE(course.under_way());

  arrive_at_first_stop(course);
  EXPECT_TRUE(course.stop().ended);
  EXPECT_EQ(course.result().end, PathEnd::stopped);
  EXPECT_FALSE(course.under_way());
}

// Adams-Bashforth with unequal steps: with k rates known, polynomials of degree k - 1 in the pilot
// are integrated exactly, whatever the tangents' pilot entries are.
TEST(CourseProceed, IntegratesPolynomialsExactly) {
  const std::vector<double> stops_deg = {5, 6, 9, 10.5, 20, 21};
  const std::vector<double> tangent_pilots = {0.5, -0.125, 0.3, 0.7, -0.11, 0.2};
  const PathPlan plan = plan_of(stops_deg);
  Course course;
  course.begin(plan, 0, 0);
  for (std::size_t k = 0; k + 1 < stops_deg.size(); ++k) {
    Reading reading = solution_at(stops_deg[k], stops_deg[k]);
    reading.tangent_pilot = tangent_pilots[k];
    ASSERT_TRUE(course.after(reading).arrived);
    const Move move = course.proceed();
    EXPECT_TRUE(move.depart && move.hold);
    EXPECT_EQ(move.pilot.s, plan.stops[k + 1].pilot.s);
    const double from = stops_deg[k] * kRadPerDeg, to = stops_deg[k + 1] * kRadPerDeg;
    for (std::size_t degree = 0; degree < std::min<std::size_t>(k + 1, 3); ++degree) {
      const double power = static_cast<double>(degree);
      double moved = 0;
      for (std::size_t j = 0; j < std::min<std::size_t>(k + 1, 3); ++j) {
        const double rate = std::pow(stops_deg[k - j] * kRadPerDeg, power);
        moved += move.along[j] * std::abs(tangent_pilots[k - j]) * rate;
      }
      const double exact = (std::pow(to, power + 1) - std::pow(from, power + 1)) / (power + 1);
      // A dozen roundings of weights below 3 rad.
      EXPECT_NEAR(moved, exact, 1e-15) << "degree " << degree << " after stop " << k;
    }
    for (std::size_t j = k + 1; j < 3; ++j) EXPECT_EQ(move.along[j], 0);
  }
}

}  // namespace
}  // namespace misalign::solver
