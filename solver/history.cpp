#include "solver/history.hpp"

#include "solver/diagonals.hpp"
#include "solver/singular_value.hpp"

namespace misalign::solver {
namespace {

Eigen::MatrixXd rows_of(const std::vector<std::vector<double>>& rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    matrix.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[i].data(), columns);
  }
  return matrix;
}

}  // namespace

FoldingHistory record_history(const PerforatedSheet& base, const Mechanism& mechanism,
                              const PathPlan& plan, const FlatVertices& vertices_mm) {
  SheetGeometry<double> geometry;
  place(mechanism, vertices_mm, geometry);
  const FoldedShape shape(base.sheet, base.holes, mechanism);
  ClosureSystem system(mechanism);
  DenseSolve factors(mechanism.equations);
  SmallestSingularValue smallest(mechanism.equations);

  FoldingHistory history;
  std::vector<double> lengths(mechanism.diagonals.size());
  flat_lengths(mechanism, geometry, lengths.data());
  Judge judge(mechanism);
  judge.begin(lengths);
  for (const double length : lengths) history.flat_mm.push_back(length * mechanism.panel_width_mm);

  std::vector<std::vector<double>> lengths_mm, angles_deg;
  PathTracker tracker(mechanism);
  history.path =
      tracker.follow(geometry, plan, [&](const Stop& stop, const FoldState<double>& state) {
        folded_lengths(mechanism, geometry, state, lengths.data());
        if (stop.sample > 0) judge.see(stop, state, lengths);
        history.stops.push_back(stop);
        for (double& length : lengths_mm.emplace_back(lengths)) length *= mechanism.panel_width_mm;
        auto& angles = angles_deg.emplace_back();
        for (const auto& rho : state.creases) angles.push_back(angle_deg(rho));
        history.open_by.push_back(system.evaluate(geometry, state));
        factors.factorize(system.jacobian().leftCols(mechanism.equations));
        history.singular_value_min.push_back(smallest.of(factors));
        history.isometry_error_mm.push_back(
            shape.isometry_error_mm(vertices_mm, shape.vertices_mm(geometry, state)));
        return true;
      });
  history.verdict = judge.conclude(history.path);
  history.length_mm = rows_of(lengths_mm, static_cast<Eigen::Index>(mechanism.diagonals.size()));
  history.fold_angle_deg = rows_of(angles_deg, static_cast<Eigen::Index>(mechanism.creases.size()));
  return history;
}

}  // namespace misalign::solver
