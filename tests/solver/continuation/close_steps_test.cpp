// Close steps alone, fed with made-up reports: what is believed, and when they go along the arc.
#include "solver/continuation/close_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/solver/continuation/usual_steps.hpp"

namespace misalign::solver {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A solution at this pilot, nothing wrong with it.
NewtonReport solution_at(double pilot_deg) {
  return {0.5 * kUsual.closure_tolerance, 1e-8, +1, 0.25, 1, half_angle_of_deg(pilot_deg), 0.01};
}
PathStart start_of(const PathPlan& plan, std::size_t first_station = 0, int forward_sign = 0) {
  return {nullptr, nullptr, &plan, first_station, forward_sign};
}
NewtonReport open_by(double open, NewtonReport reading) {
  reading.open_by = open;
  return reading;
}

bool does_nothing(const PathStep& move) {
  return !move.keep && !move.arrived && !move.ended && !move.depart && !move.hold;
}

class CloseStepsTest : public testing::Test {
 protected:
  // Step control has arrived at 10 degrees and is on its way to 20.
  void arrive_at_first_station(CloseSteps& control) {
    control.begin(start_of(plan_));
    EXPECT_TRUE(control.after(solution_at(10)).arrived);
    EXPECT_TRUE(control.proceed().hold);
  }
  // 10 degrees in a first step: half the way to the station along a tangent of pilot entry 0.25 is
  // more than the longest step.
  void expect_arc_begins(const CloseSteps& control, const PathStep& move) {
    EXPECT_TRUE(control.is_free());
    EXPECT_TRUE(move.depart);
    EXPECT_FALSE(move.hold || move.keep || move.arrived || move.ended);
    for (int place = 0; place < kStatePlaces; ++place) {
      EXPECT_EQ(move.of_values[place], place == 0 ? 1 : 0);
      EXPECT_EQ(move.of_rates[place], place == 0 ? kUsual.arc.longest_step_rad : 0);
    }
  }

  const PathPlan plan_ = stations_at({10, 20, 30});
  const NewtonReport at_10_ = solution_at(10), at_20_ = solution_at(20);
};

TEST_F(CloseStepsTest, ConvergedStartArrives) {
  for (const double tangent_pilot : {0.25, -0.25}) {
    CloseSteps control(kUsual);
    control.begin(start_of(plan_));
    EXPECT_TRUE(does_nothing(control.after(open_by(1e-3, at_10_))));
    NewtonReport reading = at_10_;
    reading.tangent_pilot = tangent_pilot;
    reading.orientation = tangent_pilot < 0 ? 1 : -1;
    EXPECT_EQ(reading.determinant_sign(), -1);
    const PathStep move = control.after(reading);
    EXPECT_TRUE(move.keep && move.arrived);
    EXPECT_FALSE(move.ended || move.depart);
    EXPECT_EQ(move.tangent_sign, tangent_pilot > 0 ? 1 : -1);  // towards a growing pilot
    EXPECT_EQ(control.result().forward_sign, -1);
    EXPECT_EQ(control.result().newton_solves, 1);
    EXPECT_EQ(control.result().newton_iterations, 2);
    EXPECT_EQ(control.result().fold_limit_deg, 10);
  }
}

TEST_F(CloseStepsTest, ClosureToleranceFromBothSides) {
  CloseSteps control(kUsual);
  control.begin(start_of(plan_));
  EXPECT_TRUE(does_nothing(control.after(open_by(1.001 * kUsual.closure_tolerance, at_10_))));
  EXPECT_TRUE(control.after(open_by(kUsual.closure_tolerance, at_10_)).arrived);
}

// But for the first one: near flat a correction that is not needed does harm.
TEST_F(CloseStepsTest, StationIsCorrectedBeforeItIsBelieved) {
  CloseSteps control;
  arrive_at_first_station(control);
  EXPECT_TRUE(does_nothing(control.after(at_20_)));
  EXPECT_TRUE(control.after(at_20_).arrived);
}

// From the base folding the second correction may open the loops again, the third not.
TEST_F(CloseStepsTest, GrowingResidualAtTheStart) {
  CloseSteps control(kUsual);
  control.begin(start_of(plan_));
  for (const double open : {1e-4, 1e-7, 2e-7}) {
    EXPECT_TRUE(does_nothing(control.after(open_by(open, at_10_))));
  }
  EXPECT_TRUE(control.after(open_by(2e-7, at_10_)).ended);
  EXPECT_EQ(control.result().end, PathEnd::start_lost);
}

// Later one that grows in the first iteration may still converge; after that it is lost.
TEST_F(CloseStepsTest, GrowingResidualWalks) {
  CloseSteps control(kUsual);
  arrive_at_first_station(control);
  EXPECT_TRUE(does_nothing(control.after(open_by(1e-3, at_20_))));
  EXPECT_TRUE(does_nothing(control.after(open_by(1e-2, at_20_))));
  expect_arc_begins(control, control.after(open_by(1e-2, at_20_)));
}

TEST_F(CloseStepsTest, ResidualThatIsNoNumberWalks) {
  for (const double open : {kNoNumber, std::numeric_limits<double>::infinity()}) {
    CloseSteps control(kUsual);
    arrive_at_first_station(control);
    expect_arc_begins(control, control.after(open_by(open, at_20_)));
  }
}

// A loop may look closed where the largest of many entries is not a number.
TEST_F(CloseStepsTest, TangentThatIsNoNumberIsNeverBelieved) {
  NewtonReport reading = at_10_;
  reading.open_by = 0;
  reading.tangent_pilot = kNoNumber;
  CloseSteps control(kUsual);
  control.begin(start_of(plan_));
  EXPECT_TRUE(control.after(reading).ended);
  EXPECT_EQ(control.result().end, PathEnd::start_lost);
  arrive_at_first_station(control);
  expect_arc_begins(control, control.after(reading));
}

TEST_F(CloseStepsTest, OneCorrectionTooManyWalks) {
  for (const int corrections : {kUsual.max_corrections, kUsual.max_corrections + 1}) {
    CloseSteps control(kUsual);
    arrive_at_first_station(control);
    for (int k = 0; k < kUsual.max_corrections; ++k) {
      EXPECT_TRUE(does_nothing(control.after(open_by(std::pow(0.5, k), at_20_))));
    }
    if (corrections == kUsual.max_corrections) {
      EXPECT_TRUE(control.after(at_20_).arrived);
    } else {
      expect_arc_begins(control, control.after(open_by(1e-11, at_20_)));
    }
  }
}

TEST_F(CloseStepsTest, ChangedDeterminantSignWalks) {
  CloseSteps control(kUsual);
  arrive_at_first_station(control);
  NewtonReport reading = at_20_;
  reading.orientation = -1;
  expect_arc_begins(control, control.after(reading));
  EXPECT_EQ(control.result().forward_sign, +1);
}

TEST_F(CloseStepsTest, JumpWalksFromItsBoundOn) {
  for (const double half_sine :
       {kUsual.longest_half_sine, 1.001 * kUsual.longest_half_sine, kNoNumber}) {
    CloseSteps control(kUsual);
    arrive_at_first_station(control);
    EXPECT_TRUE(control.asks_for_turn(kUsual.closure_tolerance));
    NewtonReport reading = at_20_;
    reading.largest_half_sine = half_sine;
    const PathStep move = control.after(reading);
    if (half_sine == kUsual.longest_half_sine) {
      EXPECT_TRUE(move.arrived);
    } else {
      expect_arc_begins(control, move);
      EXPECT_FALSE(control.asks_for_turn(0));
    }
  }
}

// All corrections since departing count together, but not those of the start, which has a bound of
// its own.
TEST_F(CloseStepsTest, LongCorrectionsWalkFromTheirBoundOn) {
  CloseSteps::Options options = kUsual;
  options.longest_correction_rad = 0.125;
  for (const double second : {0.0625, 0.0626, kNoNumber}) {
    CloseSteps control(options);
    control.begin(start_of(plan_));
    NewtonReport reading = at_10_;
    reading.correction_rad = 0.08;
    EXPECT_TRUE(control.after(reading).arrived);
    control.proceed();
    reading = open_by(1e-3, at_20_);
    reading.correction_rad = 0.0625;
    EXPECT_TRUE(does_nothing(control.after(reading)));
    reading.open_by = 0;
    reading.correction_rad = second;
    const PathStep move = control.after(reading);
    if (second == 0.0625) {
      EXPECT_TRUE(move.arrived);
    } else {
      expect_arc_begins(control, move);
    }
  }
}

// What lies farther from the base folding than half of the pilot's angle may be another branch.
TEST_F(CloseStepsTest, StartIsLostBeyondHalfOfThePilotsAngle) {
  const double bound_rad = kUsual.longest_start_share * 10 * kRadPerDeg;
  for (const double share : {0.999, 1.001}) {
    CloseSteps control(kUsual);
    control.begin(start_of(plan_));
    NewtonReport reading = open_by(1e-3, at_10_);
    reading.correction_rad = 0.5 * bound_rad;
    EXPECT_TRUE(does_nothing(control.after(reading)));
    reading = at_10_;
    reading.correction_rad = (share - 0.5) * bound_rad;
    const PathStep move = control.after(reading);
    if (share < 1) {
      EXPECT_TRUE(move.arrived);
    } else {
      EXPECT_TRUE(move.ended);
      EXPECT_EQ(control.result().end, PathEnd::start_lost);
    }
  }
}

TEST_F(CloseStepsTest, StartIsLostWhereNothingWasBelievedYet) {
  NewtonReport jump = at_10_, other_half = at_10_;
  jump.correction_rad = 0.1;
  other_half.orientation = -1;
  for (const NewtonReport& reading : {open_by(kNoNumber, at_10_), jump, other_half}) {
    CloseSteps control(kUsual);
    control.begin(start_of(plan_, 0, +1));
    const PathStep move = control.after(reading);
    EXPECT_TRUE(move.ended);
    EXPECT_FALSE(move.keep || move.arrived || move.depart);
    EXPECT_EQ(control.result().end, PathEnd::start_lost);
    EXPECT_FALSE(control.under_way());
  }
}

TEST_F(CloseStepsTest, EndsAtTheLastStationOrWhenTheVisitorHasSeenEnough) {
  CloseSteps control(kUsual);
  control.begin(start_of(plan_, 1));  // the second of three stations
  EXPECT_TRUE(control.after(solution_at(20)).arrived);
  EXPECT_TRUE(control.proceed().depart);
  EXPECT_TRUE(control.after(solution_at(30)).arrived);
  EXPECT_TRUE(control.proceed().ended);
  EXPECT_EQ(control.result().end, PathEnd::end_reached);
  EXPECT_EQ(control.result().fold_limit_deg, 30);
  EXPECT_FALSE(control.under_way());

  arrive_at_first_station(control);
  EXPECT_TRUE(control.stop().ended);
  EXPECT_EQ(control.result().end, PathEnd::stopped);
  EXPECT_FALSE(control.under_way());
}

// Through k nodes, polynomials of degree 2 k - 1 in the pilot are continued exactly, whatever the
// tangents' pilot entries are.
TEST(CloseStepsProceed, ContinuesPolynomialsExactly) {
  const std::vector<double> stops_deg = {5, 6, 9, 10.5, 20, 21};
  const std::vector<double> tangent_pilots = {0.5, -0.125, 0.3, 0.7, -0.11, 0.2};
  const PathPlan plan = stations_at(stops_deg);
  CloseSteps control(kUsual);
  control.begin(start_of(plan));
  for (std::size_t k = 0; k + 1 < stops_deg.size(); ++k) {
    NewtonReport reading = solution_at(stops_deg[k]);
    reading.tangent_pilot = tangent_pilots[k];
    reading.orientation = tangent_pilots[k] < 0 ? -1 : 1;
    ASSERT_TRUE(control.after(reading).arrived);
    const PathStep move = control.proceed();
    EXPECT_TRUE(move.depart && move.hold);
    EXPECT_EQ(move.pilot.s, plan.stations[k + 1].pilot.s);
    const std::size_t nodes = std::min<std::size_t>(k + 1, CloseSteps::kNodes);
    // About the middle of the nodes, in units that leave powers of the order of one.
    const auto x_of = [&](std::size_t stop) { return (stops_deg[stop] - stops_deg[k]) / 15; };
    for (std::size_t degree = 0; degree < 2 * nodes; ++degree) {
      const double power = static_cast<double>(degree);
      double value = 0, terms = 0;
      for (std::size_t j = 0; j < nodes; ++j) {
        const std::size_t place = (k - j) % kStatePlaces;
        const double x = x_of(k - j);
        const double rate_per_rad =
            degree == 0 ? 0 : power * std::pow(x, power - 1) / 15 / kRadPerDeg;
        const double of_rate =
            move.of_rates[place] * std::abs(tangent_pilots[k - j]) * rate_per_rad;
        value += move.of_values[place] * std::pow(x, power) + of_rate;
        terms += std::abs(move.of_values[place] * std::pow(x, power)) + std::abs(of_rate);
      }
      // Two dozen roundings of its terms, and of weights that cancel.
      EXPECT_NEAR(value, std::pow(x_of(k + 1), power), 1e-13 * (1 + terms))
          << "degree " << degree << " after station " << k;
    }
    for (std::size_t place = nodes; place < kStatePlaces && k < CloseSteps::kNodes; ++place) {
      EXPECT_EQ(move.of_values[place], 0);
    }
  }
}

}  // namespace
}  // namespace misalign::solver
