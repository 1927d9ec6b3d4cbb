#include "solver/linear/mobility.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "solver/linear/newton.hpp"
#include "solver/linear/singular_value.hpp"

namespace misalign::solver {
namespace {

// Singular values below this (rad and panel widths) count as zero. The least true one at the angles
// looked at is 1e-2 on 6 x 6, 7e-4 on 20 x 20 and goes like the number of facets; of a sheet that
// lacks rank, coordinates written to 1e-4 mm on 80 mm panels leave 2e-6.
constexpr double kLeastSingularValue = 1e-5;

}  // namespace

Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding) {
  const Mechanism mechanism = build_mechanism(sheet, holes, folding);
  SheetGeometry<double> geometry;
  place(mechanism, sheet.vertices_mm, geometry);
  ClosureSystem system(mechanism);
  Mobility mobility{mechanism.unknowns, mechanism.equations, 0};
  for (const double of_180 : {40.0, 75.0, 110.0}) {
    const double pilot_deg = of_180 / 180 * folding.end_deg();
    const auto state =
        base_state(mechanism, folding, sheet.vertices_mm, half_angle_of_deg(pilot_deg));
    system.evaluate(geometry, state);
    if (mechanism.unknowns == mechanism.equations + 1) {
      // The usual case, cheaper than the rank itself: the square Jacobian is regular.
      DenseSolve factors(mechanism.equations);
      factors.factorize(system.jacobian().leftCols(mechanism.equations));
      const double smallest = SmallestSingularValue<double>(mechanism.equations).of(factors);
      if (smallest > kLeastSingularValue) {
        mobility.rank = mechanism.equations;
        return mobility;
      }
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(system.jacobian());
    qr.setThreshold(kLeastSingularValue / qr.maxPivot());
    mobility.rank = std::max(mobility.rank, static_cast<int>(qr.rank()));
  }
  return mobility;
}

}  // namespace misalign::solver
