// Certificates that the energy of what fills the holes rises: beside the energies of lengths of
// Newton's states in steps of 0.01 degrees; false ones are refused.
#include <gtest/gtest.h>

#include <random>

#include "solver/certificate/certificate_check.hpp"
#include "solver/certificate/certifier.hpp"
#include "solver/certificate/taylor_model.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

constexpr double kStep_deg = 0.01;

// Sheets of 4 x 4 with shifts of 0.4 mm.
class EnergySheet {
 public:
  EnergySheet(unsigned seed, const Fill& fill, double asked_deg)
      : fill_(fill), model_(sheet_.base) {
    std::mt19937 random(seed);
    for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
      for (int i = 0; i < 2; ++i) vertices_mm(i, v) += 0.4 * (static_cast<int>(random() % 3) - 1);
    }
    place(sheet_.mechanism, vertices_mm, geometry_);
    const Certificate made = Certifier(model_, false, fill).certify(vertices_mm, asked_deg);
    certificate = *decode(sheet_.mechanism, encode(sheet_.mechanism, made));
  }

  std::string fault_of(const Certificate& claims, const std::optional<Fill>& fill) const {
    const auto fault = check_certificate(sheet_.mechanism, vertices_mm, claims, fill);
    return fault ? fault->what : "";
  }
  std::string fault_of(const Certificate& claims) const { return fault_of(claims, fill_); }

  // Flat lengths of the diagonals, mm.
  double flat_mm(const Diagonal& diagonal) const {
    return (vertices_mm.col(diagonal.to) - vertices_mm.col(diagonal.from)).norm();
  }

  FoldState<double> solved(FoldState<double> near, double pilot_deg) const {
    near.creases[static_cast<std::size_t>(sheet_.mechanism.pilot)] = half_angle_of_deg(pilot_deg);
    EXPECT_EQ(Newton(sheet_.mechanism).correct(geometry_, near).end, Newton::StopReason::converged);
    return near;
  }
  std::vector<double> lengths_mm(const FoldState<double>& state) const {
    std::vector<double> all(sheet_.mechanism.diagonals.size());
    folded_lengths(sheet_.mechanism, geometry_, state, all.data());
    for (double& length : all) length *= sheet_.mechanism.panel_width_mm;
    return all;
  }

  // The first pilot angle, in steps of 0.01 degrees from `from_deg` to `to_deg`, behind which the
  // energy falls; `to_deg` where there is none.
  template <class Energy>
  double first_fall_deg(double from_deg, double to_deg, const Energy& energy) const {
    FoldState<double> state = solved(certificate.intervals.front().middle, from_deg);
    double last = energy(lengths_mm(state));
    for (int k = 1; from_deg + k * kStep_deg <= to_deg; ++k) {
      state = solved(state, from_deg + k * kStep_deg);
      const double next = energy(lengths_mm(state));
      if (!(next > last)) return from_deg + (k - 1) * kStep_deg;
      last = next;
    }
    return to_deg;
  }

  const Mechanism& mechanism() const { return sheet_.mechanism; }

 private:
  TestSheet sheet_{4, 4};
  const Fill fill_;
  const Model model_;
  SheetGeometry<double> geometry_;

 public:
  FlatVertices vertices_mm = sheet_.base.sheet.vertices_mm;
  Certificate certificate;
};

// Half the rate times the squares of elongations: not Filling.
double energy_of_springs(const EnergySheet& sheet, const std::vector<double>& lengths_mm,
                         double preload_over_rate_mm = 0, const std::vector<int>& sides = {}) {
  double sum = 0;
  for (std::size_t d = 0; d < lengths_mm.size(); ++d) {
    double longer_mm = lengths_mm[d] - sheet.flat_mm(sheet.mechanism().diagonals[d]);
    if (!sides.empty()) longer_mm += sides[d] * preload_over_rate_mm;
    sum += longer_mm * longer_mm;
  }
  return sum;
}

// The sweep's first fall is seen within a step of the maximum.
void expect_end_of_sweep(const Certificate& certificate, double fall_deg, unsigned seed) {
  if (certificate.end == CertificateEnd::reversal) {
    EXPECT_NEAR(fall_deg, certificate.certified_deg(), kStep_deg + kClosing_deg) << seed;
  } else {
    EXPECT_GE(fall_deg, certificate.certified_deg() - kStep_deg) << seed;
  }
}

TEST(EnergyCertificate, ends_where_energies_of_a_sweep_fall) {
  int reversals = 0, to_the_end = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const EnergySheet sheet(seed, Springs{}, 175);
    ASSERT_GT(sheet.certificate.certified_deg(), 1) << seed;
    const double to_deg = std::min(175.0, sheet.certificate.certified_deg() + 2 * kStep_deg);
    const bool is_reversal = sheet.certificate.end == CertificateEnd::reversal;
    const double fall_deg =
        sheet.first_fall_deg(1, is_reversal ? to_deg : sheet.certificate.certified_deg(),
                             [&](const auto& mm) { return energy_of_springs(sheet, mm); });
    expect_end_of_sweep(sheet.certificate, fall_deg, seed);
    reversals += is_reversal ? 1 : 0;
    to_the_end += sheet.certificate.end == CertificateEnd::to_the_end ? 1 : 0;
  }
  EXPECT_GT(reversals, 0);
  EXPECT_GT(to_the_end, 0);
}

TEST(EnergyCertificate, takes_preloads_into_account) {
  Springs springs;
  springs.preload.each_n = 5;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const EnergySheet sheet(seed, springs, 170);
    ASSERT_GT(sheet.certificate.certified_deg(), 1) << seed;
    std::vector<int> sides;
    const auto near_flat =
        sheet.lengths_mm(sheet.solved(sheet.certificate.intervals.front().middle, 1));
    for (std::size_t d = 0; d < near_flat.size(); ++d) {
      sides.push_back(near_flat[d] > sheet.flat_mm(sheet.mechanism().diagonals[d]) ? 1 : -1);
    }
    const bool is_reversal = sheet.certificate.end == CertificateEnd::reversal;
    const double fall_deg = sheet.first_fall_deg(
        1, sheet.certificate.certified_deg() + (is_reversal ? 2 * kStep_deg : 0),
        [&](const auto& mm) { return energy_of_springs(sheet, mm, 5.0 / 50, sides); });
    expect_end_of_sweep(sheet.certificate, fall_deg, seed);
    EXPECT_EQ(sheet.fault_of(sheet.certificate), "") << seed;
  }
}

// G t A0 / 2 (I1 + 1 / J^2 - 3) of the deformation that takes the flat hole's diagonals, shrunk, to
// folded ones: F = [x y] [x0 y0]^-1 in a plane, by its entries.
double energy_of_plates(const EnergySheet& sheet, const std::vector<double>& lengths_mm,
                        double prestretch) {
  double sum = 0;
  const auto& diagonals = sheet.mechanism().diagonals;
  for (std::size_t d = 0; d < lengths_mm.size(); d += 2) {
    Eigen::Matrix2d flat, folded;
    for (int k = 0; k < 2; ++k) {
      const Diagonal& diagonal = diagonals[d + static_cast<std::size_t>(k)];
      flat.col(k) = sheet.vertices_mm.col(diagonal.to) - sheet.vertices_mm.col(diagonal.from);
    }
    const double a = lengths_mm[d], b = lengths_mm[d + 1];
    const double cosine = flat.col(0).dot(flat.col(1)) / (a * b);
    folded << a, b * cosine, 0, b * std::sqrt(1 - cosine * cosine);
    const Eigen::Matrix2d f = folded * (flat / prestretch).inverse();
    const double j = f.determinant();
    sum += std::abs(flat.determinant()) * (f.squaredNorm() + 1 / (j * j) - 3);
  }
  return sum;
}

TEST(EnergyCertificate, is_of_plates_that_are_tense) {
  int far = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    RubberPlates plates;
    plates.prestretch = 1.2;
    const EnergySheet sheet(seed, plates, 150);
    if (sheet.certificate.certified_deg() < 1) continue;  // it falls from flat on
    const bool is_reversal = sheet.certificate.end == CertificateEnd::reversal;
    const double fall_deg = sheet.first_fall_deg(
        1, sheet.certificate.certified_deg() + (is_reversal ? 2 * kStep_deg : 0),
        [&](const auto& mm) { return energy_of_plates(sheet, mm, 1.2); });
    expect_end_of_sweep(sheet.certificate, fall_deg, seed);
    EXPECT_EQ(sheet.fault_of(sheet.certificate), "") << seed;
    far += sheet.certificate.certified_deg() > 60 ? 1 : 0;
  }
  EXPECT_GT(far, 0);
}

TEST(EnergyCertificate, is_checked_and_refused_where_false) {
  int reversals = 0;
  for (unsigned seed = 0; seed < 20 && reversals < 2; ++seed) {
    const EnergySheet sheet(seed, Springs{}, 175);
    const Certificate& made = sheet.certificate;
    if (made.end != CertificateEnd::reversal) continue;
    ++reversals;
    EXPECT_EQ(sheet.fault_of(made), "");
    EXPECT_EQ(sheet.fault_of(made, std::nullopt),
              "it is of an energy, and nothing is known of what fills the holes");
    EXPECT_NE(sheet.fault_of(made, NoFill{}), "");
    Springs stop;
    stop.rest_deg = 90;
    EXPECT_NE(sheet.fault_of(made, stop), "");
    Springs few;
    few.on = SpringsOn::one_a_hole;
    EXPECT_NE(sheet.fault_of(made, few), "");
    // The certificate is no proof of its diagonals; the closing piece does not rise.
    Certificate other = made;
    other.criterion = CertifiedBy::diagonals;
    EXPECT_NE(sheet.fault_of(other), "");
    other = made;
    other.intervals.push_back(*made.closing);
    other.closing.reset();
    other.asked_deg = other.certified_deg();
    other.end = CertificateEnd::to_the_end;
    EXPECT_EQ(sheet.fault_of(other), "the energy is not proven to go on rising");
    // A shorter closing piece does not show the fall.
    other = made;
    other.closing->to_deg =
        made.certified_deg() + 1e-3 * (made.closing->to_deg - made.certified_deg());
    EXPECT_NE(sheet.fault_of(other), "");
    // Other springs have another energy: the spring of the diagonal that reverses first, alone.
    const Certificate of_diagonals =
        Certifier(Model(TestSheet(4, 4).base)).certify(sheet.vertices_mm, 175);
    if (of_diagonals.end != CertificateEnd::reversal) continue;
    const Diagonal& first =
        sheet.mechanism().diagonals[static_cast<std::size_t>(of_diagonals.where)];
    Springs alone;
    alone.stiffness_n_per_mm = 0;
    alone.single = {{first.from, first.to, 50, std::nullopt}};
    EXPECT_EQ(sheet.fault_of(made, alone), "the energy is not proven to go on rising");
  }
  EXPECT_EQ(reversals, 2);
}

// A root of a Taylor model holds the roots of its values.
TEST(TaylorModelRoot, holds_roots_of_values) {
  TaylorModel<9> f(2.0);
  f.c[1] = 0.5;
  f.c[2] = -0.3;
  f.c[5] = 0.01;
  const TaylorModel<9> root = square_root(f);
  EXPECT_LT(root.radius, 1e-3);
  for (double s = -1; s <= 1; s += 0.125) {
    const Ball value = value_at(root, Ball(s));
    EXPECT_LE(std::abs(value.c[0] - std::sqrt(guess_at(f, s))), value.radius);
  }
  f.c[1] = 1.9;  // negative at s = -1
  EXPECT_FALSE(std::isfinite(square_root(f).radius));
}

}  // namespace
}  // namespace misalign::solver
