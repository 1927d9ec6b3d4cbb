// Speed of the frozen reference on draws of miura-6x6, and of the parts of the sparse solver in one
// lane: residual, Jacobian, factorisation, solves, one path. `misalign bench` has the lanes.
#include <benchmark/benchmark.h>

#include "schema/campaign/campaign_file.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "solver/continuation/path_follower.hpp"
#include "solver/linear/pivot_order.hpp"
#include "solver/records/record_sheet.hpp"
#include "solver/reference/reference.hpp"
#include "tests/solver/record_path.hpp"

namespace misalign {
namespace {

struct Draws {
  Draws()
      : campaign(
            schema::read_campaign_file(MISALIGN_SOURCE_DIR "/search/campaigns/miura-6x6.json")),
        base(campaign.pattern.base),
        mechanism(solver::build_mechanism(base)),
        plan(solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, campaign.path())),
        shifts(Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count())) {}

  const solver::FlatVertices& next() {
    search::draw_shifts(campaign.misalignment, campaign.seed, draw++ % 200, shifts);
    vertices = base.sheet.vertices_mm + shifts;
    return vertices;
  }

  schema::Campaign campaign;
  const solver::PerforatedSheet& base;
  solver::Mechanism mechanism;
  solver::PathPlan plan;
  Eigen::Matrix2Xd shifts;
  solver::FlatVertices vertices;
  std::uint64_t draw = 0;
};

void first_fault_stops(benchmark::State& state) {
  Draws draws;
  solver::Reference reference(draws.mechanism, draws.plan);
  for (auto _ : state) benchmark::DoNotOptimize(reference.judge(draws.next()));
}
BENCHMARK(first_fault_stops)->Unit(benchmark::kMillisecond)->Iterations(400);

void full_path(benchmark::State& state) {
  Draws draws;
  solver::PathTracker tracker(draws.mechanism);
  solver::SheetGeometry<double> geometry;
  for (auto _ : state) {
    solver::place(draws.mechanism, draws.next(), geometry);
    benchmark::DoNotOptimize(tracker.follow(
        geometry, draws.plan,
        [](const solver::Station&, const solver::FoldState<double>&) { return true; }));
  }
}
BENCHMARK(full_path)->Unit(benchmark::kMillisecond)->Iterations(200);

void full_path_with_metrics(benchmark::State& state) {
  Draws draws;
  const solver::Model model(draws.base, draws.campaign.path());
  for (auto _ : state) {
    const auto& vertices = draws.next();
    const auto record = solver::record_path(model, vertices);
    benchmark::DoNotOptimize(solver::measure(model, vertices, record));
  }
}
BENCHMARK(full_path_with_metrics)->Unit(benchmark::kMillisecond)->Iterations(100);

// The sparse solver at the base folding, 100 degrees, of one misaligned sheet.
struct Parts : Draws {
  Parts()
      : elimination(solver::plan_elimination(mechanism, base.folding, base.sheet.vertices_mm)),
        lu(elimination),
        state(solver::base_state(mechanism, base.folding, base.sheet.vertices_mm,
                                 solver::half_angle_of_deg(100))),
        residual(mechanism.equations),
        y(mechanism.unknowns),
        x(mechanism.unknowns) {
    solver::place(mechanism, next(), geometry);
    solver::evaluate(mechanism, geometry, state, residual.data(), lu.entries());
    lu.factorize();
  }

  solver::Elimination elimination;
  solver::SparseLu<double> lu;
  solver::FoldState<double> state;
  solver::SheetGeometry<double> geometry;
  std::vector<double> residual, y, x;
};

void residual(benchmark::State& state) {
  Parts p;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        solver::evaluate(p.mechanism, p.geometry, p.state, p.residual.data(), nullptr));
  }
}
BENCHMARK(residual);

void residual_and_jacobian(benchmark::State& state) {
  Parts p;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        solver::evaluate(p.mechanism, p.geometry, p.state, p.residual.data(), p.lu.entries()));
  }
}
BENCHMARK(residual_and_jacobian);

void jacobian_and_factorisation(benchmark::State& state) {
  Parts p;
  for (auto _ : state) {
    solver::evaluate(p.mechanism, p.geometry, p.state, p.residual.data(), p.lu.entries());
    p.lu.factorize();
    benchmark::ClobberMemory();
  }
}
BENCHMARK(jacobian_and_factorisation);

void solve_with_factors(benchmark::State& state) {
  Parts p;
  for (auto _ : state) {
    p.lu.forward(p.residual.data(), p.y.data());
    p.lu.backward(p.y.data(), p.y[p.mechanism.equations - 1] / p.lu.partner_coefficient(), 0.0,
                  p.x.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(solve_with_factors);

// A path to its end, in one lane.
struct OnePath {
  solver::PathPoint& place;
  solver::PathPoint& point() { return place; }
  bool wants_slopes() const { return false; }
  bool see(const solver::Station&, int) { return true; }
  void ended(const solver::PathResult&, int) {}
};

void full_path_sparse(benchmark::State& state) {
  Parts p;
  solver::PathFollower<double> follower(p.mechanism, p.elimination);
  solver::PathPoint point(p.mechanism);
  for (auto _ : state) {
    solver::place(p.mechanism, p.next(), p.geometry);
    OnePath path{point};
    follower.follow({&p.geometry, &p.plan.start, &p.plan}, path);
  }
}
BENCHMARK(full_path_sparse)->Unit(benchmark::kMillisecond)->Iterations(200);

}  // namespace
}  // namespace misalign

BENCHMARK_MAIN();
