#include "tests/bench/work_precision/mesh.hpp"

#include <cstdio>

#include "search/draws/draw.hpp"
#include "solver/pattern/miura.hpp"
#include "solver/pattern/perforation.hpp"
#include "tests/bench/work_precision/clock.hpp"
#include "tests/bench/work_precision/corrector.hpp"

namespace misalign::bench {
namespace {

constexpr int kSizes[] = {4, 6, 8, 10, 14, 20, 28, 40};
constexpr int kLargestDense = 20;

// The stretch of the path that is followed on every size, in steps of 1 degree: far from flat and
// from any fold limit.
constexpr int kFrom_deg = 60, kTo_deg = 70;
constexpr double kTolerance = 1e-12;

struct MeshSheet {
  solver::CreasePattern sheet;
  solver::BaseFolding folding;
  solver::Mechanism mechanism;
  solver::SheetGeometry<double> geometry;
};

// Draw 0 of the paper's kind of misalignment on n x n panels.
MeshSheet mesh_sheet(int n) {
  const auto shape = solver::MiuraShape::uniform(n, n, 80, 80, 40);
  MeshSheet mesh;
  mesh.sheet = solver::miura_sheet(shape);
  const std::vector<int> holes = solver::checkerboard(mesh.sheet, 1);
  mesh.folding = std::get<solver::BaseFolding>(
      solver::fold_sequentially(mesh.sheet, solver::miura_assignment(shape, mesh.sheet),
                                solver::default_pilot(mesh.sheet, holes)));
  mesh.mechanism = solver::build_mechanism({mesh.sheet, holes, mesh.folding});
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, mesh.sheet.vertex_count());
  search::draw_shifts({.vertices = solver::interior_vertices(mesh.sheet)}, 1, 0, shifts_mm);
  solver::place(mesh.mechanism, mesh.sheet.vertices_mm + shifts_mm, mesh.geometry);
  return mesh;
}

template <class Linear>
void measure(int n, int repeats) {
  const MeshSheet mesh = mesh_sheet(n);
  const solver::Mechanism& mechanism = mesh.mechanism;
  const auto state_at = [&](double pilot_deg) {
    return solver::base_state(mechanism, mesh.folding, mesh.sheet.vertices_mm,
                              solver::half_angle_of_deg(pilot_deg));
  };
  const solver::FoldState<double> start = state_at(kFrom_deg);

  const std::size_t nonzeros = solver::jacobian_entries(mechanism).size();
  std::vector<double> values(nonzeros);
  std::vector<double> residual(static_cast<std::size_t>(mechanism.equations)), x(residual);
  const Topology topology{mechanism, mesh.folding, mesh.sheet.vertices_mm};
  Linear linear(topology);
  Corrector<double, Linear> corrector(topology, kTolerance);

  std::vector<double> evaluate_us, linear_us, path_us;
  Effort effort;
  bool converged = true;
  solver::FoldState<double> first = start, state = start;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    evaluate_us.push_back(elapsed_each_us([&] {
      solver::evaluate<double>(mechanism, mesh.geometry, start, residual.data(), values.data());
    }));
    linear_us.push_back(elapsed_each_us([&] {
      linear.factorize(values.data());
      linear.solve(residual.data(), x.data());
    }));
    converged = corrector.correct(mesh.geometry, first, effort) && converged;
    path_us.push_back(elapsed_each_us([&] {
      effort = {};
      state = first;
      for (int degree = kFrom_deg + 1; degree <= kTo_deg; ++degree) {
        state.creases[mechanism.pilot] = solver::half_angle_of_deg(degree);
        converged = corrector.correct(mesh.geometry, state, effort) && converged;
      }
    }));
  }
  const int steps = kTo_deg - kFrom_deg;
  std::printf("%d,%d,%zu,%s,%.2f,%.2f,%.1f,%.1f,%.2f,%s\n", n, mechanism.equations, nonzeros,
              Linear::kName, median(evaluate_us), median(linear_us), median(path_us) / steps,
              median(path_us), static_cast<double>(effort.corrections) / steps,
              converged ? "yes" : "no");
  std::fflush(stdout);
}

}  // namespace

void measure_mesh(int repeats) {
  std::printf(
      "panels_a_side,unknowns,jacobian_values,linear_solver,evaluate_us,factorize_and_solve_us,"
      "step_us,path_us,corrections_per_step,converged\n");
  // One more linear solver is one more line here.
  for (const int n : kSizes) {
    if (n <= kLargestDense) measure<DenseLinear<double>>(n, repeats);
    measure<EigenSparseLinear>(n, repeats);
    measure<FixedOrderLinear<double>>(n, repeats);
  }
}

}  // namespace misalign::bench
