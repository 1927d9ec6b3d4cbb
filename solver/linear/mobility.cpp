#include "solver/linear/mobility.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cassert>

#include "solver/kinematics/loop_closure.hpp"
#include "solver/linear/dissection.hpp"
#include "solver/linear/sparse_rank.hpp"

namespace misalign::solver {
namespace {

// Singular values below this (rad and panel widths) count as zero. The least true one at the tested
// angles is 1e-2 on 6 x 6, 7e-4 on 20 x 20, 2e-4 on 40 x 40, inversely proportional to the number
// of facets. If a sheet lacks rank, coordinates written to 1e-4 mm on 80 mm panels leave 2e-6.
constexpr double kLeastSingularValue = 1e-5;

using Sparse = Eigen::SparseMatrix<double>;

Sparse jacobian_at(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                   const FoldState<double>& state) {
  const std::vector<JacobianEntry> entries = jacobian_entries(mechanism);
  std::vector<double> values(entries.size()), residual(mechanism.equations);
  evaluate(mechanism, geometry, state, residual.data(), values.data());
  std::vector<Eigen::Triplet<double>> places;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    places.emplace_back(entries[k].row, entries[k].column, values[k]);
  }
  Sparse jacobian(mechanism.equations, mechanism.unknowns);
  jacobian.setFromTriplets(places.begin(), places.end());
  return jacobian;
}

// Returns whether all singular values of a square matrix are large enough, by inverse iteration on
// J J^T. Each step gives an upper bound of the least one, the last within a part in a million.
bool is_regular(const Sparse& square) {
  assert(square.rows() == square.cols());
  constexpr int kMostIterations = 500;
  constexpr double kRelativeChange = 1e-6;
  Eigen::SparseLU<Sparse> lu;
  lu.compute(square);
  if (lu.info() != Eigen::Success) return false;
  const Eigen::Index size = square.cols();
  Eigen::VectorXd direction = Eigen::VectorXd::LinSpaced(size, 1, 2).normalized(), next;
  for (double last = 0, k = 0; k < kMostIterations; ++k) {
    next = lu.solve(direction);
    const double inverse = next.norm();
    if (!(inverse * kLeastSingularValue < 1)) return false;
    if (std::abs(inverse - last) <= kRelativeChange * inverse) return true;
    last = inverse;
    direction = lu.transpose().solve(next.normalized()).normalized();
  }
  return true;
}

}  // namespace

Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding) {
  const Mechanism mechanism = build_mechanism({sheet, holes, folding});
  SheetGeometry<double> geometry;
  place(mechanism, sheet.vertices_mm, geometry);
  std::vector<int> order;
  for (const std::vector<int>& part : dissect(mechanism, sheet.vertices_mm)) {
    order.insert(order.end(), part.begin(), part.end());
  }
  Mobility mobility{mechanism.unknowns, mechanism.equations, 0};
  assert(std::ssize(order) == mechanism.unknowns);
  for (const double of_180 : {40.0, 75.0, 110.0}) {
    const double pilot_deg = of_180 / 180 * folding.end_deg();
    const Sparse jacobian = jacobian_at(
        mechanism, geometry,
        base_state(mechanism, folding, sheet.vertices_mm, half_angle_of_deg(pilot_deg)));
    if (mechanism.unknowns == mechanism.equations + 1 &&
        is_regular(jacobian.leftCols(mechanism.equations))) {
      mobility.rank = mechanism.equations;
      return mobility;
    }
    mobility.rank = std::max(mobility.rank, sparse_rank(jacobian, order, kLeastSingularValue));
  }
  return mobility;
}

}  // namespace misalign::solver
