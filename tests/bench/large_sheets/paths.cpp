#include "tests/bench/large_sheets/paths.hpp"

#include "search/draws/draw.hpp"
#include "solver/pattern/miura.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::bench {
namespace {

constexpr int kSheets = 8;

}  // namespace

LargeSheets::LargeSheets(int panels) {
  const auto shape = solver::MiuraShape::uniform(panels, panels, 80, 80, 40);
  base.sheet = solver::miura_sheet(shape);
  base.holes = solver::checkerboard(base.sheet, 1);
  base.folding = std::get<solver::BaseFolding>(
      solver::fold_sequentially(base.sheet, solver::miura_assignment(shape, base.sheet),
                                solver::default_pilot(base.sheet, base.holes)));
  mechanism = solver::build_mechanism(base);
  plan = solver::plan_path(mechanism, base.folding, base.sheet.vertices_mm, {.end_deg = kEnd_deg});
  for (int draw = 0; draw < kSheets; ++draw) {
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count());
    search::draw_shifts({.vertices = solver::interior_vertices(base.sheet)}, 1,
                        static_cast<std::uint64_t>(draw), shifts_mm);
    drawn_mm.push_back(base.sheet.vertices_mm + shifts_mm);
    solver::place(mechanism, drawn_mm.back(), drawn.emplace_back());
  }
}

bool WholePaths::next(solver::PathStart& start, int) {
  if (followed_.paths == paths_) return false;
  const auto sheet = static_cast<std::size_t>(followed_.paths++) % sheets_.drawn.size();
  start = {&sheets_.drawn[sheet], &sheets_.plan.start, &sheets_.plan};
  return true;
}

void WholePaths::ended(const solver::PathResult& path, int) {
  followed_.iterations += path.newton_iterations;
  followed_.to_the_end += path.end == solver::PathEnd::end_reached;
}

double cpu_now_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace misalign::bench
