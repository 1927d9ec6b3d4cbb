// Models of tubes beside the functions that they stand for, in complex arithmetic on the circle |s|
// = 0.99: proofs of wells need them there, too.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>

#include "../blocks.hpp"
#include "solver/certificate/energy_slope.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {
namespace {

constexpr int kPlaces = 64;
constexpr double kCircle = 0.99;

// A complex number as closures take numbers.
struct Complex {
  std::complex<double> z;
  Complex(double re = 0) : z(re) {}  // NOLINT: a number is a complex number
  explicit Complex(std::complex<double> value) : z(value) {}
  Complex operator-() const { return Complex(-z); }
  friend Complex operator+(const Complex& a, const Complex& b) { return Complex(a.z + b.z); }
  friend Complex operator-(const Complex& a, const Complex& b) { return Complex(a.z - b.z); }
  friend Complex operator*(const Complex& a, const Complex& b) { return Complex(a.z * b.z); }
  friend Complex operator*(double k, const Complex& a) { return Complex(k * a.z); }
  Complex& operator+=(const Complex& b) { return *this = *this + b; }
  friend Complex reciprocal(const Complex& x) { return Complex(1.0 / x.z); }
};

std::complex<double> value_at(const PathModel& f, std::complex<double> s) {
  std::complex<double> sum = 0;
  for (int k = kPathDegree; k >= 0; --k) sum = sum * s + f.c[static_cast<std::size_t>(k)];
  return sum;
}

// A tube of a drawn sheet, and the energy of its springs all over it.
struct ComplexTube {
  ComplexTube(double from_deg, double to_deg, const Springs& its) : springs(its) {
    const HalfAngle<double> end = half_angle_of_deg(to_deg);
    const bool is_first = from_deg == 0;
    const HalfAngle<double> middle = is_first ? half_angle_of_ratio(std::sqrt(0.5) * end.s, end.c)
                                              : half_angle_of_deg((from_deg + to_deg) / 2);
    const double middle_deg = angle_deg(middle);
    const PathInterval interval{from_deg, to_deg, is_first, 0, sheet.at(middle_deg).state};
    EXPECT_EQ(prover.prove(interval, 2e-5, tube), TubeProver::End::proven);
    EnergySlope energy(drawn.mechanism, springs, prover.flat_diagonals());
    const DiagonalsAlong diagonals = prover.find_diagonals(tube);
    energy.begin(diagonals.slopes);
    along = energy.along(tube, diagonals);
    place(drawn.mechanism, sheet.vertices_mm(), flat);
    geometry = convert<Complex>(flat);
  }

  // The closure at these unknowns and s.
  template <class Use>
  void with_closure(std::vector<Complex> x, std::complex<double> s, Use&& use) const {
    if (!tube.chart.is_graded()) x.back() = Complex(tube.chart.half_width() * s);
    const GradedBy<Complex> sigma{sigma_at(s)};
    use(GradedClosure<Complex, GradedBy<Complex>>(drawn.mechanism, geometry, tube.chart.joints(),
                                                  sigma, x.data()));
  }
  Complex sigma_at(std::complex<double> s) const {
    return tube.chart.is_graded() ? Complex(tube.chart.sigma() + tube.chart.half_width() * s)
                                  : Complex(1.0);
  }

  // The solution at a complex s, by Newton's method from the polynomials.
  std::vector<Complex> solved(std::complex<double> s) const {
    const Eigen::Index n = drawn.mechanism.equations;
    std::vector<Complex> x(static_cast<std::size_t>(n) + 1);
    for (std::size_t j = 0; j < x.size() - 1; ++j) x[j] = Complex(value_at(tube.path[j], s));
    for (int step = 0; step < 3; ++step) {
      std::vector<Complex> residual(static_cast<std::size_t>(n)), values;
      with_closure(x, s, [&](const auto& at) { at.evaluate(residual.data(), &values); });
      Eigen::MatrixXcd jacobian = Eigen::MatrixXcd::Zero(n, n);
      Eigen::VectorXcd opening(n);
      for (Eigen::Index j = 0; j < n; ++j) {
        const Krawczyk::Column& column = krawczyk.columns()[static_cast<std::size_t>(j)];
        for (std::size_t k = 0; k < column.rows.size(); ++k) {
          jacobian(column.rows[k], j) = values[static_cast<std::size_t>(column.values[k])].z;
        }
        opening(j) = residual[static_cast<std::size_t>(j)].z;
      }
      const Eigen::VectorXcd correction = jacobian.partialPivLu().solve(opening);
      for (Eigen::Index j = 0; j < n; ++j) x[static_cast<std::size_t>(j)].z -= correction(j);
    }
    return x;
  }

  // Sum of k / 2 (L - F)^2 by complex lengths.
  std::complex<double> energy_n_mm(const std::vector<Complex>& x, std::complex<double> s) const {
    const double width_mm = drawn.mechanism.panel_width_mm;
    std::complex<double> sum = 0;
    with_closure(x, s, [&](const auto& at) {
      for (const SingleSpring& spring : springs.single) {
        const auto d = static_cast<std::size_t>(&spring - springs.single.data());
        const Diagonal& diagonal = drawn.mechanism.diagonals[d];
        const double flat_mm = (sheet.point_mm(diagonal.to) - sheet.point_mm(diagonal.from)).norm();
        const std::complex<double> change =
            (sigma_at(s) * at.squared_elongation(diagonal)).z * (width_mm * width_mm);
        const std::complex<double> longer = std::sqrt(flat_mm * flat_mm + change) - *spring.free_mm;
        sum += spring.stiffness_n_per_mm / 2 * longer * longer;
      }
    });
    return sum;
  }

  const DrawableSheet drawn{4, 4};
  const Model model{drawn.base, drawn.shifted_vertices, {}, 0};
  SheetSolver solver{model};
  const Sheet sheet{solver, drawn.vertices(drawn.draws(1, 3, 5), 0) - drawn.base.sheet.vertices_mm};
  const Springs springs;
  TubeProver prover{drawn.mechanism, sheet.vertices_mm()};
  const Krawczyk krawczyk{drawn.mechanism};
  PathTube tube;
  EnergyAlong along;
  SheetGeometry<double> flat;
  SheetGeometry<Complex> geometry;
};

// The free lengths are those of the flat base: any numbers will do.
Springs base_springs() {
  const DrawableSheet drawn(4, 4);
  Springs springs;
  for (const Diagonal& diagonal : drawn.mechanism.diagonals) {
    const auto at = [&](int v) { return drawn.base.sheet.vertices_mm.col(v); };
    springs.single.push_back(
        {{diagonal.from, diagonal.to}, 50, (at(diagonal.to) - at(diagonal.from)).norm()});
  }
  return springs;
}

class ComplexTubes : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(ComplexTubes, HoldThePathAndTheEnergyOfComplexPlaces) {
  const ComplexTube at(GetParam().first, GetParam().second, base_springs());
  std::vector<std::complex<double>> energies, places;
  double farthest = 0;  // over a radius
  for (int k = 0; k < kPlaces; ++k) {
    const std::complex<double> s = std::polar(kCircle, 2 * std::numbers::pi * k / kPlaces);
    const std::vector<Complex> x = at.solved(s);
    for (std::size_t j = 0; j + 1 < x.size(); ++j) {
      const double off = std::abs(x[j].z - value_at(at.tube.path[j], s));
      EXPECT_LE(off, at.tube.path[j].radius + 1e-14) << s;
      farthest = std::max(farthest, off / at.tube.path[j].radius);
    }
    places.push_back(s);
    energies.push_back(at.energy_n_mm(x, s));
    EXPECT_LE(std::abs(energies.back() - value_at(at.along.n_mm, s)), at.along.n_mm.radius);
  }
  EXPECT_GT(farthest, 0.01) << "radii are of the size of the errors there";
  // The derivative by the energy's Taylor series, from its Fourier series on the circle; the
  // slope's constant is 2 over the panel width.
  for (const std::complex<double> s : places) {
    std::complex<double> slope = 0;
    for (int k = 1; k < kPlaces / 2; ++k) {
      std::complex<double> power = 0;
      for (int j = 0; j < kPlaces; ++j) {
        power += energies[static_cast<std::size_t>(j)] *
                 std::polar(1.0 / kPlaces, -2 * std::numbers::pi * j * k / kPlaces);
      }
      slope += power * static_cast<double>(k) * std::pow(s / kCircle, k - 1) / kCircle;
    }
    slope *= 2 / at.drawn.mechanism.panel_width_mm;
    EXPECT_LE(std::abs(slope - value_at(at.along.slope, s)), at.along.slope.radius + 1e-11) << s;
  }
}

INSTANTIATE_TEST_SUITE_P(AtFlatAndBeyond, ComplexTubes,
                         testing::Values(std::pair(0.0, 8.0), std::pair(80.0, 87.0)));

}  // namespace
}  // namespace misalign::solver
