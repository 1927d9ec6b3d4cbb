// Speed of the frozen reference on draws of miura-6x6: the whole path, and ending at the first
// fault.
#include <benchmark/benchmark.h>

#include "search/draw.hpp"
#include "search/trial.hpp"
#include "solver/reference.hpp"

namespace misalign {
namespace {

struct Draws {
  Draws()
      : campaign(
            schema::read_campaign_file(MISALIGN_SOURCE_DIR "/search/campaigns/miura-6x6.json")),
        base(campaign.pattern.base),
        mechanism(solver::build_mechanism(base.sheet, base.holes, base.folding)),
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
    benchmark::DoNotOptimize(
        tracker.follow(geometry, draws.plan,
                       [](const solver::Stop&, const solver::FoldState<double>&) { return true; }));
  }
}
BENCHMARK(full_path)->Unit(benchmark::kMillisecond)->Iterations(200);

void full_path_with_metrics(benchmark::State& state) {
  Draws draws;
  for (auto _ : state) {
    const auto& vertices = draws.next();
    const auto history = solver::record_history(draws.base, draws.mechanism, draws.plan, vertices);
    benchmark::DoNotOptimize(solver::measure(draws.base, vertices, history, 1));
  }
}
BENCHMARK(full_path_with_metrics)->Unit(benchmark::kMillisecond)->Iterations(100);

}  // namespace
}  // namespace misalign

BENCHMARK_MAIN();
