// Certificates beside Newton's method: their polynomials hold its states, their slopes are those of
// its lengths, and they end where its lengths turn.
#include "solver/certificate/certifier.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <random>

#include "solver/certificate/tube_prover.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "tests/solver/own_spring_ends.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// The paper's sheet of Table 1.
struct PaperSheet {
  TestSheet sheet{6, 6};
  Mechanism mechanism;
  FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json").at("displacements_mm"));
  SheetGeometry<double> geometry;
  PerforatedSheet base = sheet.base;
  Model model;
  Certificate certificate = Certifier(model).certify(vertices_mm, 180);

  explicit PaperSheet(const SpringEnds& springs = {})
      : model([&] {
          base.springs = springs;
          return base;
        }()) {
    mechanism = build_mechanism(base);
    place(mechanism, vertices_mm, geometry);
  }

  /// The state at an angle next to that of a state.
  FoldState<double> solved(FoldState<double> near, double pilot_deg) const {
    near.creases[static_cast<std::size_t>(mechanism.pilot)] = half_angle_of_deg(pilot_deg);
    EXPECT_EQ(Newton(mechanism).correct(geometry, near).end, Newton::StopReason::converged);
    return near;
  }
  std::vector<double> lengths(const FoldState<double>& state) const {
    std::vector<double> all(mechanism.diagonals.size());
    folded_lengths(mechanism, geometry, state, all.data());
    return all;
  }
};

const PaperSheet& paper() {
  static const PaperSheet sheet;
  return sheet;
}

// The same with its springs in bores, most of them where no rule says.
const PaperSheet& bored() {
  static const PaperSheet sheet(with_own(TestSheet(6, 6).base, {6, 0}, 0));
  return sheet;
}

IntervalChart::PlainState exactly(const FoldState<double>& state) {
  IntervalChart::PlainState plain;
  for (const HalfAngle<double>& h : state.creases) plain.creases.push_back({Ball(h.c), Ball(h.s)});
  for (const Quaternion<double>& q : state.balls) {
    plain.balls.push_back({Ball(q.w), Ball(q.x), Ball(q.y), Ball(q.z)});
  }
  return plain;
}

// Newton's method leaves loops open by 1e-12, and J^-1 is below 100 here.
constexpr double kSolved = 1e-10;

TEST(Certifier, holds_the_states_of_newtons_method) {
  const PaperSheet& sheet = paper();
  TubeProver prover(sheet.mechanism, sheet.vertices_mm);
  for (const PathInterval& interval : sheet.certificate.intervals) {
    PathTube tube;
    ASSERT_EQ(prover.prove(interval, 2 * interval.box, tube), TubeProver::End::proven)
        << interval.from_deg;
    for (const double part : {0.05, 0.3, 0.5, 0.8, 1.0}) {
      const double at_deg = interval.from_deg + part * (interval.to_deg - interval.from_deg);
      const Ball s = tube.chart.place_of(at_deg);
      std::vector<double> near(tube.path.size());
      for (std::size_t j = 0; j < near.size(); ++j) near[j] = value_at(tube.path[j], s).c[0];
      const FoldState<double> state =
          sheet.solved(tube.chart.state_at(near.data(), s.c[0]), at_deg);
      const std::vector<Ball> x = tube.chart.unknowns(exactly(state), at_deg);
      for (std::size_t j = 0; j < x.size(); ++j) {
        const Ball p = value_at(tube.path[j], s);
        // Graded unknowns are over the pilot's tangent, or its square.
        const double allowed = interval.graded ? 1e3 * kSolved : kSolved;
        ASSERT_LE(std::abs(x[j].c[0] - p.c[0]), p.radius + allowed)
            << "unknown " << j << " at " << at_deg;
      }
    }
  }
}

void expect_slopes_of_lengths(const PaperSheet& sheet) {
  TubeProver prover(sheet.mechanism, sheet.vertices_mm);
  for (const std::size_t k :
       {std::size_t{0}, std::size_t{1}, std::size_t{12}, sheet.certificate.intervals.size() - 4}) {
    const PathInterval& interval = sheet.certificate.intervals.at(k);
    PathTube tube;
    ASSERT_EQ(prover.prove(interval, 2 * interval.box, tube), TubeProver::End::proven);
    const std::vector<PathModel> slopes = prover.find_diagonals(tube).slopes;
    const double at_deg = 0.3 * interval.from_deg + 0.7 * interval.to_deg;
    constexpr double kStep_deg = 1e-3;
    const auto behind = sheet.lengths(sheet.solved(interval.middle, at_deg - kStep_deg));
    const auto ahead = sheet.lengths(sheet.solved(interval.middle, at_deg + kStep_deg));
    const double step =
        tube.chart.place_of(at_deg + kStep_deg).c[0] - tube.chart.place_of(at_deg - kStep_deg).c[0];
    for (std::size_t d = 0; d < slopes.size(); ++d) {
      const double by_lengths = (ahead[d] * ahead[d] - behind[d] * behind[d]) / step;
      const Ball slope = value_at(slopes[d], tube.chart.place_of(at_deg));
      // Lengths are known to 1e-12, third derivatives along s are below 1.
      EXPECT_NEAR(slope.c[0], by_lengths, slope.radius + 4e-12 / step + step * step)
          << "diagonal " << d << " at " << at_deg;
    }
  }
}

TEST(Certifier, has_the_slopes_of_its_lengths) {
  expect_slopes_of_lengths(paper());
  expect_slopes_of_lengths(bored());
}

// The last interval's end and 0.01 degrees on either side: a parabola through three lengths.
void expect_end_at_a_turn(const PaperSheet& sheet) {
  const Certificate& certificate = sheet.certificate;
  ASSERT_EQ(certificate.end, CertificateEnd::reversal);
  ASSERT_TRUE(certificate.closing);
  const auto where = static_cast<std::size_t>(certificate.where);
  const double end_deg = certificate.certified_deg();
  constexpr double kStep_deg = 0.01;
  double length[3];
  for (int k = 0; k < 3; ++k) {
    const auto state = sheet.solved(certificate.closing->middle, end_deg + (k - 1) * kStep_deg);
    length[k] = sheet.lengths(state)[where];
  }
  const double first = length[2] - length[0], second = length[2] - 2 * length[1] + length[0];
  const double turn_deg = end_deg - 0.5 * kStep_deg * first / second;
  // The closing interval, and what the parabola leaves out: some h^2 of a relative change of the
  // curvature of 1 per degree.
  EXPECT_NEAR(turn_deg, end_deg, kClosing_deg + kStep_deg * kStep_deg);
  // The other diagonals go on.
  EXPECT_LT(certificate.closing->to_deg - end_deg, kClosing_deg);
}

TEST(Certifier, ends_where_a_diagonal_turns_back) {
  expect_end_at_a_turn(paper());
  expect_end_at_a_turn(bored());
}

TEST(Certifier, ends_at_the_angle_that_is_asked_for) {
  const PaperSheet& sheet = paper();
  Certifier certifier(sheet.model);
  for (const double asked_deg : {0.1, 1.0, 11.99, 61.9999, 62.0, 62.00001, 155.0}) {
    const Certificate certificate = certifier.certify(sheet.vertices_mm, asked_deg);
    EXPECT_EQ(certificate.end, CertificateEnd::to_the_end) << asked_deg;
    EXPECT_EQ(certificate.certified_deg(), asked_deg);
    double from_deg = 0;
    for (const PathInterval& interval : certificate.intervals) {
      EXPECT_EQ(interval.from_deg, from_deg);
      from_deg = interval.to_deg;
    }
  }
}

// Of the unshifted sheet no diagonal changes at all.
TEST(Certifier, certifies_nothing_where_diagonals_stand_still) {
  const TestSheet sheet(4, 4);
  const Model model(sheet.base);
  const Certificate certificate = Certifier(model).certify(sheet.base.sheet.vertices_mm, 90);
  EXPECT_EQ(certificate.end, CertificateEnd::unclear_slope);
  EXPECT_EQ(certificate.certified_deg(), 0);
  EXPECT_GE(certificate.where, 0);
}

TEST(Certifier, proves_nothing_by_other_rounding) {
  const PaperSheet& sheet = paper();
  Certifier certifier(sheet.model);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const Certificate certificate = certifier.certify(sheet.vertices_mm, 90);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(certificate.end, CertificateEnd::flat_branch);
    EXPECT_EQ(certificate.certified_deg(), 0);
  }
}

TEST(CertificateBytes, are_read_as_written) {
  const PaperSheet& sheet = paper();
  const std::string bytes = encode(sheet.mechanism, sheet.certificate);
  const auto kept = decode(sheet.mechanism, bytes);
  ASSERT_TRUE(kept);
  EXPECT_EQ(encode(sheet.mechanism, *kept), bytes);
  EXPECT_EQ(kept->end, sheet.certificate.end);
  EXPECT_EQ(kept->where, sheet.certificate.where);
  EXPECT_EQ(kept->certified_deg(), sheet.certificate.certified_deg());
  for (std::size_t k = 0; k < kept->intervals.size(); ++k) {
    const FoldState<double>&theirs = kept->intervals[k].middle,
          &ours = sheet.certificate.intervals[k].middle;
    // Half a unit of single precision, of numbers up to 1, times four.
    for (std::size_t i = 0; i < ours.creases.size(); ++i) {
      EXPECT_NEAR(theirs.creases[i].s, ours.creases[i].s, 0x1p-23);
    }
    for (std::size_t i = 0; i < ours.balls.size(); ++i) {
      const Quaternion<double> turn = theirs.balls[i] * ours.balls[i].conjugate();
      EXPECT_NEAR(std::abs(turn.w), 1, 0x1p-40);
    }
  }
}

TEST(CertificateBytes, are_refused_where_they_are_none) {
  const PaperSheet& sheet = paper();
  const std::string bytes = encode(sheet.mechanism, sheet.certificate);
  EXPECT_FALSE(decode(sheet.mechanism, ""));
  EXPECT_FALSE(decode(sheet.mechanism, bytes.substr(0, bytes.size() - 1)));
  EXPECT_FALSE(decode(sheet.mechanism, bytes + '\0'));
  EXPECT_FALSE(decode(TestSheet(4, 4).mechanism, bytes));
  // The last crease's number, and the angle that was asked for, are none.
  for (const std::size_t at : {bytes.size() - 4, std::size_t{28}}) {
    std::string spoilt = bytes;
    for (std::size_t k = 0; k < (at == 28 ? 8u : 4u); ++k) spoilt[at + k] = '\xff';
    EXPECT_FALSE(decode(sheet.mechanism, spoilt)) << at;
  }
}

// The closure's Jacobian beside differences of its residual, graded and not.
TEST(GradedClosure, has_the_jacobian_of_its_residual) {
  const PaperSheet& sheet = paper();
  const Mechanism& mechanism = sheet.mechanism;
  const std::vector<Krawczyk::Column> columns = Krawczyk(mechanism).columns();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> small(-0.01, 0.01);
  for (const std::size_t k : {std::size_t{0}, sheet.certificate.intervals.size() - 1}) {
    const IntervalChart chart(mechanism, sheet.certificate.intervals[k]);
    std::vector<double> x(static_cast<std::size_t>(mechanism.unknowns));
    for (double& one : x) one = small(random);
    const auto residual = [&](std::vector<double>* values) {
      std::vector<double> rows(static_cast<std::size_t>(mechanism.equations));
      const GradedBy<double> sigma{chart.is_graded() ? chart.sigma() : 1};
      GradedClosure<double, GradedBy<double>>(mechanism, sheet.geometry, chart.joints(), sigma,
                                              x.data())
          .evaluate(rows.data(), values);
      return rows;
    };
    std::vector<double> values;
    residual(&values);
    constexpr double kStep = 1e-5;
    for (int j = 0; j < mechanism.equations; ++j) {
      const double at = x[static_cast<std::size_t>(j)];
      x[static_cast<std::size_t>(j)] = at + kStep;
      auto difference = residual(nullptr);
      x[static_cast<std::size_t>(j)] = at - kStep;
      const auto behind = residual(nullptr);
      x[static_cast<std::size_t>(j)] = at;
      for (std::size_t i = 0; i < behind.size(); ++i) {
        difference[i] = (difference[i] - behind[i]) / (2 * kStep);
      }
      const Krawczyk::Column& column = columns[static_cast<std::size_t>(j)];
      for (std::size_t e = 0; e < column.rows.size(); ++e) {
        // Rounding over the step, and the step's square.
        double& there = difference[static_cast<std::size_t>(column.rows[e])];
        EXPECT_NEAR(values[static_cast<std::size_t>(column.values[e])], there, 1e-8);
        there = 0;
      }
      for (const double rest : difference) EXPECT_NEAR(rest, 0, 1e-8);
    }
  }
}

// What a spring in bores gains by each joint between its ends, beside differences.
TEST(GradedClosure, has_the_rates_of_springs_beside_the_vertices) {
  const PaperSheet& sheet = bored();
  const Mechanism& mechanism = sheet.mechanism;
  SheetGeometry<double> geometry = sheet.geometry;
  for (const Loop& loop : mechanism.loops) {
    for (int corner = 0; corner < 4; ++corner) {
      const auto end = loop.hole < 0 ? Vec3<double>{0, 0, 0}
                                     : spring_end(mechanism, sheet.geometry, loop, corner);
      geometry.x.push_back(end.x);
      geometry.y.push_back(end.y);
    }
  }
  std::mt19937 random(2);
  std::uniform_real_distribution<double> small(-0.01, 0.01);
  for (const std::size_t k : {std::size_t{0}, sheet.certificate.intervals.size() - 1}) {
    const IntervalChart chart(mechanism, sheet.certificate.intervals[k]);
    std::vector<double> x(static_cast<std::size_t>(mechanism.unknowns));
    for (double& one : x) one = small(random);
    const GradedBy<double> sigma{chart.is_graded() ? chart.sigma() : 1};
    const auto closure = [&] {
      return GradedClosure<double, GradedBy<double>>(mechanism, geometry, chart.joints(), sigma,
                                                     x.data());
    };
    constexpr double kStep = 1e-5;
    for (const Diagonal& diagonal : mechanism.diagonals) {
      std::vector<double> rates(x.size(), 0.0);
      closure().squared_elongation_rates(diagonal, [&](int column, double rate) {
        rates[static_cast<std::size_t>(column)] = rate;
      });
      for (std::size_t j = 0; j < x.size(); ++j) {
        const double at = x[j];
        x[j] = at + kStep;
        const double ahead = closure().squared_elongation(diagonal);
        x[j] = at - kStep;
        const double behind = closure().squared_elongation(diagonal);
        x[j] = at;
        // Rounding over the step, and the step's square; larger numbers where over sigma.
        EXPECT_NEAR(rates[j], (ahead - behind) / (2 * kStep), 1e-7) << j;
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
