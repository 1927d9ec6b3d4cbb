// The check of certificates: true ones pass, and every kind of claim that is not so is refused.
#include "solver/certificate/certificate_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "solver/certificate/certifier.hpp"
#include "solver/certificate/proven_interval.hpp"
#include "solver/contact/contact_finder.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "tests/solver/own_spring_ends.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// The certificate with its states rounded as in encoding.
Certificate as_kept(const Mechanism& mechanism, const Certificate& certificate) {
  return *decode(mechanism, encode(mechanism, certificate));
}

// A sheet of 4 x 4 with shifts of 0.4 mm, some drawn before it, and its certificate as it is kept.
struct CertifiedSheet {
  CertifiedSheet(int draw, double asked_deg) : vertices_mm(sheet.base.sheet.vertices_mm) {
    std::mt19937 random(7);
    for (int k = 0; k <= draw; ++k) {
      vertices_mm = sheet.base.sheet.vertices_mm;
      for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
        for (int i = 0; i < 2; ++i) vertices_mm(i, v) += 0.4 * (static_cast<int>(random() % 3) - 1);
      }
    }
    const Model model(sheet.base);
    certificate = as_kept(sheet.mechanism, Certifier(model).certify(vertices_mm, asked_deg));
  }

  /// The fault that is found in a certificate, "" where there is none.
  std::string fault_of(const Certificate& claims) const {
    return fault_of(sheet.mechanism, claims);
  }
  std::string fault_of(const Mechanism& mechanism, const Certificate& claims) const {
    const auto fault = check_certificate(mechanism, vertices_mm, claims);
    return fault ? fault->what : "";
  }

  TestSheet sheet{4, 4};
  FlatVertices vertices_mm;
  Certificate certificate;
};

// Of draws that end in each way.
const CertifiedSheet& reversing() {
  static const CertifiedSheet sheet(3, 180);
  return sheet;
}
const CertifiedSheet& over_folding() {
  static const CertifiedSheet sheet(52, 180);
  return sheet;
}
const CertifiedSheet& limited() {
  static const CertifiedSheet sheet(50, 180);
  return sheet;
}

constexpr const char* kUnproven = "no curve of single states is proven within its box";
constexpr const char* kMiddle = "the state in its middle is not the path's";
constexpr const char* kJoin = "it does not join the piece before";
constexpr const char* kCrease =
    "a crease is not proven to keep its sign and to stay below 180 degrees";
constexpr const char* kDiagonal = "a diagonal is not proven to go on growing or shrinking";
constexpr const char* kEvent = "what ends it is not proven to happen";

TEST(CertificateCheck, passes_what_is_true) {
  EXPECT_EQ(reversing().certificate.end, CertificateEnd::reversal);
  EXPECT_EQ(reversing().fault_of(reversing().certificate), "");
  EXPECT_EQ(over_folding().certificate.end, CertificateEnd::over_folded);
  EXPECT_EQ(over_folding().fault_of(over_folding().certificate), "");
  EXPECT_EQ(limited().certificate.end, CertificateEnd::fold_limit);
  EXPECT_EQ(limited().fault_of(limited().certificate), "");
  const CertifiedSheet to_the_end(218, 180);
  EXPECT_EQ(to_the_end.certificate.end, CertificateEnd::to_the_end);
  EXPECT_EQ(to_the_end.certificate.certified_deg(), 180);
  EXPECT_EQ(to_the_end.fault_of(to_the_end.certificate), "");
}

TEST(CertificateCheck, passes_the_papers_sheet) {
  const TestSheet sheet(6, 6);
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json").at("displacements_mm"));
  const Model model(sheet.base);
  const Certificate certificate = Certifier(model).certify(vertices_mm, 40);
  EXPECT_EQ(certificate.end, CertificateEnd::to_the_end);
  const auto fault =
      check_certificate(sheet.mechanism, vertices_mm, as_kept(sheet.mechanism, certificate));
  EXPECT_FALSE(fault) << fault->what;
}

// A proof that is cut short is one, up to where it was cut; why it ends there it does not prove.
// With springs in bores a diagonal turns back elsewhere: neither's proof is the other's.
TEST(CertificateCheck, passes_springs_beside_the_vertices_and_no_others) {
  const TestSheet plain(6, 6);
  TestSheet bored(6, 6);
  bored.base.springs = with_own(plain.base, {6, 0}, 0);
  bored.mechanism = build_mechanism(bored.base);
  const FlatVertices vertices_mm = bored.shifted(golden("table1_odd.json").at("displacements_mm"));
  const Model model(bored.base);
  const Certificate certificate =
      as_kept(bored.mechanism, Certifier(model).certify(vertices_mm, 180));
  EXPECT_EQ(certificate.end, CertificateEnd::reversal);
  EXPECT_GT(certificate.certified_deg(), 150);
  EXPECT_FALSE(check_certificate(bored.mechanism, vertices_mm, certificate));
  EXPECT_TRUE(check_certificate(plain.mechanism, vertices_mm, certificate));
  const Model of_vertices(plain.base);
  const Certificate other =
      as_kept(plain.mechanism, Certifier(of_vertices).certify(vertices_mm, 180));
  EXPECT_TRUE(check_certificate(bored.mechanism, vertices_mm, other));
}

TEST(CertificateCheck, passes_what_was_cut_short_without_proving_why) {
  const CertifiedSheet& sheet = reversing();
  Certificate cut = sheet.certificate;
  cut.intervals.pop_back();
  cut.closing.reset();
  cut.end = CertificateEnd::fold_limit;
  cut.where = -1;
  EXPECT_EQ(sheet.fault_of(cut), "");
  EXPECT_FALSE(is_proven(cut.end));
  for (const CertificateEnd event : {CertificateEnd::reversal, CertificateEnd::over_folded,
                                     CertificateEnd::sign_changed, CertificateEnd::to_the_end}) {
    cut.end = event;
    cut.where = event == CertificateEnd::to_the_end ? -1 : sheet.certificate.where;
    EXPECT_NE(sheet.fault_of(cut), "");
    EXPECT_TRUE(is_proven(event));
  }
}

TEST(CertificateCheck, proves_that_panels_do_not_meet) {
  const TestSheet sheet(6, 6);
  const FlatVertices vertices_mm = sheet.shifted(golden("table1_odd.json").at("displacements_mm"));
  const Model model(sheet.base);
  Certificate certificate =
      as_kept(sheet.mechanism, Certifier(model, true).certify(vertices_mm, 15));
  EXPECT_EQ(certificate.end, CertificateEnd::to_the_end);
  EXPECT_TRUE(certificate.contact);
  const auto fault_of = [&] {
    const auto fault = check_certificate(model, vertices_mm, certificate);
    return fault ? fault->what : "";
  };
  EXPECT_EQ(fault_of(), "");
  certificate.asked_deg = 20;
  certificate.end = CertificateEnd::contact;  // between panels that there are not
  certificate.where = static_cast<int>(pairs_of(panels_of(model.base(), model.mechanism())).size());
  EXPECT_EQ(fault_of(), "there is no such place as where it ends");
  certificate.where = 0;
  certificate.contact = false;
  EXPECT_EQ(fault_of(), "it ends at a contact, and proves none");
}

TEST(CertificateCheck, refuses_intervals_with_gaps_or_out_of_order) {
  const CertifiedSheet& sheet = reversing();
  Certificate spoilt = sheet.certificate;
  spoilt.intervals[2].from_deg += 1e-9;
  EXPECT_EQ(sheet.fault_of(spoilt), "it does not begin where the one before ends");
  spoilt = sheet.certificate;
  spoilt.intervals.erase(spoilt.intervals.begin() + 1);
  EXPECT_EQ(sheet.fault_of(spoilt), "it does not begin where the one before ends");
  spoilt = sheet.certificate;
  spoilt.intervals.erase(spoilt.intervals.begin());
  EXPECT_EQ(sheet.fault_of(spoilt), "it does not begin where the one before ends");
  spoilt = sheet.certificate;
  spoilt.intervals[0].graded = false;
  EXPECT_EQ(sheet.fault_of(spoilt), "the piece at flat is not graded");
  spoilt = sheet.certificate;
  spoilt.intervals[1].to_deg = spoilt.intervals[1].from_deg;
  EXPECT_EQ(sheet.fault_of(spoilt), "its angles do not ascend");
  spoilt = sheet.certificate;
  spoilt.intervals[1].middle.balls.pop_back();
  EXPECT_EQ(sheet.fault_of(spoilt), "its state has not the sheet's joints");
}

TEST(CertificateCheck, refuses_another_end_than_it_reaches) {
  const CertifiedSheet& sheet = reversing();
  Certificate spoilt = sheet.certificate;
  spoilt.end = CertificateEnd::to_the_end;
  const char* kNotTheEnd =
      "where it ends is not the angle asked for, or that is not called its end";
  EXPECT_EQ(sheet.fault_of(spoilt), kNotTheEnd);
  spoilt.asked_deg = spoilt.certified_deg();
  spoilt.where = -1;
  EXPECT_EQ(sheet.fault_of(spoilt), "its end needs a closing piece, or must not have one");
  spoilt.asked_deg = 0.5 * spoilt.certified_deg();
  EXPECT_EQ(sheet.fault_of(spoilt), "it goes beyond the angle asked for");
  spoilt = sheet.certificate;
  spoilt.closing.reset();
  EXPECT_EQ(sheet.fault_of(spoilt), "its end needs a closing piece, or must not have one");
  spoilt = sheet.certificate;
  spoilt.contact = true;
  EXPECT_EQ(sheet.fault_of(spoilt), "nothing is known of the panels");
  spoilt = sheet.certificate;
  spoilt.where = sheet.sheet.mechanism.diagonal_count();
  EXPECT_EQ(sheet.fault_of(spoilt), "there is no such place as where it ends");
  spoilt = limited().certificate;
  spoilt.where = 0;
  EXPECT_EQ(limited().fault_of(spoilt), "there is no such place as where it ends");
  spoilt.where = -1;
  spoilt.end = CertificateEnd::flat_branch;
  EXPECT_EQ(limited().fault_of(spoilt), "it has pieces although none is proven from flat");
}

// By that half tangent: joints are kept in single precision, which takes less than a tenth of what
// is allowed.
TEST(CertificateCheck, refuses_a_middle_that_is_off) {
  const CertifiedSheet& sheet = reversing();
  constexpr double kAllowed = 0.8e-6, kTooMuch = 1.2e-6;
  const std::size_t pilot = static_cast<std::size_t>(sheet.sheet.mechanism.pilot);
  for (const std::size_t k : {std::size_t{0}, sheet.certificate.intervals.size() - 1}) {
    for (const double off : {kAllowed, kTooMuch}) {
      const char* expected = off == kAllowed ? "" : kMiddle;
      Certificate spoilt = sheet.certificate;
      spoilt.intervals.resize(k + 1);
      spoilt.closing.reset();
      spoilt.where = -1;
      spoilt.end = CertificateEnd::fold_limit;
      const Certificate whole = spoilt;
      // Graded unknowns are over the pilot's tangent, of the middle.
      const HalfAngle<double> at = whole.intervals[k].middle.creases[pilot];
      const double tau = at.s / at.c;
      for (const std::size_t i : {pilot, std::size_t{0}, std::size_t{5}}) {
        HalfAngle<double>& h = spoilt.intervals[k].middle.creases[i];
        h.s += off * tau * h.c;
        EXPECT_EQ(sheet.fault_of(spoilt), expected) << "piece " << k << ", crease " << i;
        spoilt = whole;
      }
      Quaternion<double>& q = spoilt.intervals[k].middle.balls[0];
      q.z += off * tau * tau * q.w;
      EXPECT_EQ(sheet.fault_of(spoilt), expected) << "piece " << k << ", ball";
    }
  }
}

TEST(CertificateCheck, refuses_a_box_in_which_there_is_no_proof) {
  const CertifiedSheet& sheet = reversing();
  Certificate spoilt = sheet.certificate;
  spoilt.intervals[1].box = 0.3;
  EXPECT_EQ(sheet.fault_of(spoilt), kUnproven);
  spoilt.intervals[1].box = 0;
  EXPECT_EQ(sheet.fault_of(spoilt), "its box is no size");
}

// The mirror image of a state closes every loop as well.
TEST(CertificateCheck, refuses_another_branch) {
  const CertifiedSheet& sheet = reversing();
  const auto mirrored = [](FoldState<double> state) {
    for (HalfAngle<double>& h : state.creases) h.s = -h.s;
    for (Quaternion<double>& q : state.balls) q = {q.w, -q.x, -q.y, q.z};
    return state;
  };
  Certificate spoilt = sheet.certificate;
  spoilt.intervals[1].middle = mirrored(spoilt.intervals[1].middle);
  EXPECT_NE(sheet.fault_of(spoilt), "");
}

TEST(CertificateCheck, refuses_a_crease_of_the_wrong_sign) {
  const CertifiedSheet& sheet = reversing();
  Mechanism other = sheet.sheet.mechanism;
  for (const std::size_t i : {std::size_t{1}, other.creases.size() - 1}) {
    ASSERT_NE(static_cast<int>(i), other.pilot);
    other.creases[i].assignment *= -1;
    EXPECT_EQ(sheet.fault_of(other, sheet.certificate), kCrease);
    other.creases[i].assignment *= -1;
  }
}

TEST(CertificateCheck, refuses_another_sheet) {
  CertifiedSheet sheet = reversing();
  sheet.vertices_mm(0, 6) += 0.01;
  EXPECT_EQ(sheet.fault_of(sheet.certificate), kMiddle);
}

// The closing interval, in which it happens, as one of those in which nothing does.
Certificate beyond_the_event(Certificate certificate) {
  certificate.intervals.push_back(*certificate.closing);
  certificate.closing.reset();
  certificate.where = -1;
  certificate.end = CertificateEnd::fold_limit;
  return certificate;
}

TEST(CertificateCheck, refuses_to_go_beyond_what_ends_it) {
  EXPECT_EQ(reversing().fault_of(beyond_the_event(reversing().certificate)), kDiagonal);
  EXPECT_EQ(over_folding().fault_of(beyond_the_event(over_folding().certificate)), kCrease);
  Certificate spoilt = limited().certificate;
  spoilt.intervals.back().to_deg += 1e-3;  // the fold limit is much nearer than that
  EXPECT_EQ(limited().fault_of(spoilt), kUnproven);
}

TEST(CertificateCheck, refuses_an_end_that_does_not_happen) {
  const CertifiedSheet& sheet = reversing();
  Certificate spoilt = sheet.certificate;
  spoilt.where = (spoilt.where + 1) % sheet.sheet.mechanism.diagonal_count();
  EXPECT_EQ(sheet.fault_of(spoilt), kEvent);
  spoilt = sheet.certificate;
  spoilt.closing->to_deg = spoilt.certified_deg() + 2 * kClosing_deg;
  EXPECT_EQ(sheet.fault_of(spoilt), "its closing piece is too long");
  spoilt = sheet.certificate;
  spoilt.end = CertificateEnd::sign_changed;
  spoilt.where = sheet.sheet.mechanism.pilot + 1;
  EXPECT_EQ(sheet.fault_of(spoilt), kEvent);
  spoilt.end = CertificateEnd::over_folded;
  EXPECT_EQ(sheet.fault_of(spoilt), kEvent);
  spoilt = over_folding().certificate;
  spoilt.end = CertificateEnd::sign_changed;
  EXPECT_EQ(over_folding().fault_of(spoilt), kCrease);
  spoilt = sheet.certificate;
  spoilt.closing->to_deg = spoilt.closing->from_deg + 1e-9;
  spoilt.closing->middle = spoilt.intervals.back().middle;
  EXPECT_EQ(sheet.fault_of(spoilt), kMiddle);
}

// Next to a fold limit there are two states of the same angle and signs: those on the way there,
// and those on the way back, about as far beyond the limit's own.
FoldState<double> on_the_way_back(const CertifiedSheet& sheet, const PathInterval& interval) {
  const FoldState<double>& limit = sheet.certificate.intervals.back().middle;
  FoldState<double> state = interval.middle;
  for (std::size_t i = 0; i < state.creases.size(); ++i) {
    if (static_cast<int>(i) == sheet.sheet.mechanism.pilot) continue;
    const double angle_deg_back =
        2 * angle_deg(limit.creases[i]) - angle_deg(interval.middle.creases[i]);
    state.creases[i] = half_angle_of_deg(angle_deg_back);
  }
  for (std::size_t i = 0; i < state.balls.size(); ++i) {
    const Quaternion<double>& to = limit.balls[i];
    state.balls[i] = (to * interval.middle.balls[i].conjugate() * to).normalized();
  }
  SheetGeometry<double> geometry;
  place(sheet.sheet.mechanism, sheet.vertices_mm, geometry);
  EXPECT_EQ(Newton(sheet.sheet.mechanism).correct(geometry, state).end,
            Newton::StopReason::converged);
  return state;
}

TEST(CertificateCheck, refuses_intervals_that_do_not_join) {
  const CertifiedSheet& sheet = limited();
  Mechanism only_loops = sheet.sheet.mechanism;
  only_loops.diagonals.clear();  // whose slopes are of the other sign on the way back
  Certificate spoilt = sheet.certificate;
  constexpr std::size_t kFromTheEnd = 25;
  spoilt.intervals.resize(spoilt.intervals.size() - kFromTheEnd);
  ASSERT_EQ(sheet.fault_of(only_loops, spoilt), "");
  PathInterval& last = spoilt.intervals.back();
  ASSERT_FALSE(last.graded);
  last.middle = on_the_way_back(sheet, last);
  EXPECT_EQ(sheet.fault_of(only_loops, spoilt), kJoin);
}

// The check's own formulas, at the first interval's middle, graded, and at the last one's.
class PoseClosureAtMiddle : public ::testing::TestWithParam<bool> {
 protected:
  PoseClosureAtMiddle() {
    const auto& intervals = over_folding().certificate.intervals;
    place(mechanism, over_folding().vertices_mm, geometry);
    IntervalProver prover(mechanism, over_folding().vertices_mm);
    const auto nothing = [](const ProvenInterval&, const ProvenInterval::Subinterval&) {
      return Proof::holds;
    };
    EXPECT_EQ(prover.prove(GetParam() ? intervals.front() : intervals.back(), nothing, proven),
              Proof::holds);
    sigma = {proven.interval.graded, proven.sigma};
  }
  PoseClosure<double> closure(const std::vector<double>& x) const {
    return {mechanism, geometry, proven.lines, sigma, x};
  }

  const Mechanism& mechanism = over_folding().sheet.mechanism;
  SheetGeometry<double> geometry;
  ProvenInterval proven;
  Grading<double> sigma;
};

TEST_P(PoseClosureAtMiddle, has_the_lengths_of_the_folded_sheet) {
  const std::vector<double> x(mechanism.unknowns, 0.0);
  const PoseClosure<double> at = closure(x);
  std::vector<double> flat(mechanism.diagonals.size()), folded(flat.size());
  flat_lengths(mechanism, geometry, flat.data());
  folded_lengths(mechanism, geometry, proven.interval.middle, folded.data());
  for (std::size_t d = 0; d < flat.size(); ++d) {
    const double elongation = sigma(at.squared_elongation(mechanism.diagonals[d]));
    // Loops of a state in single precision are open by some 1e-7.
    EXPECT_NEAR(elongation, folded[d] * folded[d] - flat[d] * flat[d], 2e-6) << d;
    EXPECT_GT(std::abs(elongation), 1e-4) << d;  // which is much more
  }
}

TEST_P(PoseClosureAtMiddle, has_the_jacobian_of_its_residual) {
  constexpr double kStep = 1e-5;
  constexpr double kTolerance = 1e-8;  // kStep^2, and rounding of 1e-16 over kStep, times some ten
  std::vector<double> x(mechanism.unknowns, 0.0), ahead, behind;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(mechanism.equations, mechanism.equations);
  for (const auto& entry : closure(x).jacobian()) jacobian(entry.row, entry.column) = entry.value;
  for (int j = 0; j < mechanism.equations; ++j) {
    x[j] = kStep;
    closure(x).open_by(ahead, nullptr);
    x[j] = -kStep;
    closure(x).open_by(behind, nullptr);
    x[j] = 0;
    for (int i = 0; i < mechanism.equations; ++i) {
      EXPECT_NEAR(jacobian(i, j), (ahead[i] - behind[i]) / (2 * kStep), kTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(both, PoseClosureAtMiddle, ::testing::Bool(), [](const auto& form) {
  return std::string(form.param ? "graded" : "plain");
});

}  // namespace
}  // namespace misalign::solver
