// Gradients by the vertices of the flat sheet, against differences between whole paths of sheets
// that are cut a little otherwise.
#include "solver/model/flat_gradient.hpp"

#include <random>

#include "solver/linear/newton.hpp"
#include "tests/solver/own_spring_ends.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

// Lengths, panel widths, of every diagonal with the pilot held, from the dense solver.
Eigen::VectorXd lengths_of(const TestSheet& sheet, const FlatVertices& vertices_mm,
                           FoldState<double> state) {
  SheetGeometry<double> geometry;
  place(sheet.mechanism, vertices_mm, geometry);
  Newton newton(sheet.mechanism);
  EXPECT_EQ(newton.correct(geometry, state).end, Newton::StopReason::converged);
  Eigen::VectorXd lengths(sheet.mechanism.diagonal_count());
  folded_lengths(sheet.mechanism, geometry, state, lengths.data());
  return lengths;
}

// Rows: diagonals; columns: x and y of every vertex.
Eigen::MatrixXd gradients_of(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                             const FoldState<double>& state) {
  ClosureSystem system(mechanism);
  system.evaluate(geometry, state);
  DenseSolve lu(mechanism.equations);
  lu.factorize(system.jacobian().leftCols(mechanism.equations));
  FlatGradient<double> gradient(mechanism);
  gradient.at(geometry, state);
  Eigen::MatrixXd rows(2 * mechanism.vertices, mechanism.diagonal_count());
  rows.setZero();
  Eigen::VectorXd rates(mechanism.unknowns);
  for (int d = 0; d < mechanism.diagonal_count(); ++d) {
    gradient.of_unknowns(d, rates.data());
    gradient.add_length(d, rows.col(d).data());
    const Eigen::VectorXd weights = -lu.solve_transposed(rates.head(mechanism.equations));
    gradient.add_closure(weights.data(), rows.col(d).data());
  }
  return rows.transpose();
}

// To the last bit: who has looked at a state need not walk round its loops again.
TEST(FlatGradient, LengthsAreTheFoldedOnes) {
  const TestSheet sheet(6, 6);
  SheetGeometry<double> geometry;
  place(sheet.mechanism, sheet.base.sheet.vertices_mm, geometry);
  FlatGradient<double> gradient(sheet.mechanism);
  std::vector<double> lengths(sheet.mechanism.diagonals.size());
  for (const double pilot_deg : {10.0, 60.0, 120.0}) {
    const FoldState<double> state = sheet.folded(pilot_deg);
    gradient.at(geometry, state);
    folded_lengths(sheet.mechanism, geometry, state, lengths.data());
    for (int d = 0; d < sheet.mechanism.diagonal_count(); ++d) {
      EXPECT_EQ(gradient.length(d), lengths[d]) << d << " at " << pilot_deg;
    }
  }
}

TEST(FlatGradient, EqualsDifferencesBetweenSheets) {
  const std::uint64_t seed = 20260013;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  double worst = 0;
  struct Case {
    int size;
    SpringEnds springs;
  };
  const SpringEnds own = with_own(TestSheet(4, 4).base, {3, 0}, 0.5);
  for (const auto& [size, springs] :
       {Case{4, {}}, {6, {}}, {4, {6, 0}}, {4, {3, -1.5}}, {4, own}}) {
    TestSheet sheet(size, size);
    sheet.base.springs = springs;
    sheet.mechanism = build_mechanism(sheet.base);
    const double width_mm = sheet.mechanism.panel_width_mm;
    for (const double pilot_deg : {10.0, 60.0, 120.0}) {
      FlatVertices vertices_mm = sheet.base.sheet.vertices_mm;
      for (Eigen::Index k = 0; k < vertices_mm.size(); ++k) vertices_mm.data()[k] += shift(random);
      SheetGeometry<double> geometry;
      place(sheet.mechanism, vertices_mm, geometry);
      FoldState<double> state = sheet.folded(pilot_deg);
      Newton newton(sheet.mechanism);
      ASSERT_EQ(newton.correct(geometry, state).end, Newton::StopReason::converged);
      const Eigen::MatrixXd gradients = gradients_of(sheet.mechanism, geometry, state);
      constexpr double kStep_mm = 1e-3;
      for (Eigen::Index k = 0; k < vertices_mm.size(); ++k) {
        FlatVertices more = vertices_mm, less = vertices_mm;
        more.data()[k] += kStep_mm;
        less.data()[k] -= kStep_mm;
        const Eigen::VectorXd by =
            (lengths_of(sheet, more, state) - lengths_of(sheet, less, state)) /
            (2 * kStep_mm / width_mm);
        worst = std::max(worst, (by - gradients.col(k)).cwiseAbs().maxCoeff());
      }
      EXPECT_GT(gradients.cwiseAbs().maxCoeff(), 1e-3);
    }
  }
  RecordProperty("worst", scientific(worst));
  EXPECT_LE(worst, 1e-6) << "seed " << seed;
}

}  // namespace
}  // namespace misalign::solver
