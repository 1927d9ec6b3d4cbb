// Cost of a path against the size of the sheet, beside Eigen's SparseLU in the same follower and a
// solver in vertex coordinates, and of getting ready: results/large-sheets.md.
// `large_sheets [--rounds N] [SIZE...]`
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "solver/lanes/batch.hpp"
#include "solver/linear/mobility.hpp"
#include "solver/linear/pivot_order.hpp"
#include "tests/bench/large_sheets/eigen_closure.hpp"
#include "tests/bench/large_sheets/paths.hpp"
#include "tests/solver/vertex_coordinates.hpp"

namespace misalign::bench {
namespace {

struct Row {
  int panels, unknowns;
  std::size_t operations;
  int slots;
  double ready_s, model_s, mobility_s, refusal_s;
  Followed nodes, nodes_in_lanes, close, close_in_lanes, eigen, by_vertices;
  double apart_mm = 0;  ///< diagonals of both at the end
};

// The quickest of some rounds: what others do on the machine only adds.
void keep_quicker(const Followed& now, Followed& best) {
  if (best.paths == 0 || now.path_ms() < best.path_ms()) best = now;
}

double seconds(const auto& run) {
  const double begin_s = cpu_now_s();
  run();
  return cpu_now_s() - begin_s;
}

// A hole too few: two degrees of freedom.
double refusal_seconds(int panels) {
  const LargeSheets whole(panels);
  return seconds([&] {
    std::vector<int> holes = whole.base.holes;
    holes.pop_back();
    const auto mobility = solver::measured_mobility(whole.base.sheet, holes, whole.base.folding);
    if (mobility.is_one()) std::puts("this was to be refused");
  });
}

// The first sheet in steps of a degree whose unknowns are where its vertices lie: panels keep their
// distances and stay flat. Its diagonals at the end are compared with those of the other follower.
void follow_by_vertices(const LargeSheets& sheets, const solver::FoldState<double>& end, Row& row) {
  constexpr double kStart_deg = 20;
  const solver::FoldedShape shape(sheets.base.sheet, sheets.base.holes, sheets.mechanism);
  const auto start =
      solver::base_state(sheets.mechanism, sheets.base.folding, sheets.base.sheet.vertices_mm,
                         solver::half_angle_of_deg(kStart_deg));
  solver::SheetGeometry<double> base;
  solver::place(sheets.mechanism, sheets.base.sheet.vertices_mm, base);
  const double begin_s = cpu_now_s();
  solver::VertexCoordinates vertices(sheets.base, sheets.drawn_mm.front(),
                                     shape.vertices_mm(base, start), kStart_deg);
  const bool is_there = vertices.fold_to(kEnd_deg);
  keep_quicker({1, is_there ? 1 : 0, 0, cpu_now_s() - begin_s}, row.by_vertices);
  const auto at_mm = shape.vertices_mm(sheets.drawn.front(), end);
  for (const solver::Diagonal& diagonal : sheets.mechanism.diagonals) {
    const double mm = (at_mm.col(diagonal.from) - at_mm.col(diagonal.to)).norm();
    row.apart_mm =
        std::max(row.apart_mm, std::abs(vertices.distance_mm(diagonal.from, diagonal.to) - mm));
  }
}

bool has_avx512() { return solver::available_instruction_sets().size() == 3; }

Row measure(int panels, int rounds) {
  const LargeSheets sheets(panels);
  Row row{panels, sheets.mechanism.unknowns, 0, 0, 0, 0, 0, 0, {}, {}, {}, {}, {}, {}};
  solver::Elimination elimination;
  row.ready_s = seconds([&] {
    elimination = solver::plan_elimination(sheets.mechanism, sheets.base.folding,
                                           sheets.base.sheet.vertices_mm);
  });
  row.model_s = seconds([&] {
    const solver::Model model(sheets.base, solver::interior_vertices(sheets.base.sheet),
                              {.end_deg = kEnd_deg}, 60);
  });
  row.mobility_s = seconds([&] {
    solver::measured_mobility(sheets.base.sheet, sheets.base.holes, sheets.base.folding);
  });
  row.refusal_s = refusal_seconds(panels);
  row.operations = elimination.operations();
  row.slots = elimination.slots;
  solver::PathFollower<double, solver::LongSteps> nodes(sheets.mechanism, elimination);
  solver::PathFollower<double> close(sheets.mechanism, elimination);
  solver::PathFollower<double, solver::CloseSteps, EigenClosure> eigen(
      sheets.mechanism, EigenClosure(sheets.mechanism));
  for (int round = 0; round < rounds; ++round) {
    keep_quicker(follow(nodes, sheets, 1), row.nodes);
    keep_quicker(follow(close, sheets, 1), row.close);
    follow_by_vertices(sheets, close.state(), row);
    keep_quicker(follow(eigen, sheets, 1), row.eigen);
#ifdef MISALIGN_X86
    if (!has_avx512()) continue;
    keep_quicker(follow_nodes_avx512(sheets, elimination, 16), row.nodes_in_lanes);
    keep_quicker(follow_close_avx512(sheets, elimination, 8), row.close_in_lanes);
#endif
  }
  return row;
}

void print(const Row& row) {
  std::printf(
      "| %d x %d | %d | %zu | %d | %.1f | %.1f | %.2f | %.2f | %.2f | %.2f | %.2f | %.1f | %.1f | "
      "%.0f | %.0f | %.1e | %.3f | %.3f | %.3f | %.3f |\n",
      row.panels, row.panels, row.unknowns, row.operations, row.slots,
      static_cast<double>(row.nodes.iterations) / row.nodes.paths,
      static_cast<double>(row.close.iterations) / row.close.paths, row.nodes.path_ms(),
      row.nodes_in_lanes.path_ms(), row.close.path_ms(), row.close_in_lanes.path_ms(),
      row.eigen.path_ms(), row.eigen.path_ms() / row.close.path_ms(),
      row.eigen.path_ms() / row.close_in_lanes.path_ms(), row.by_vertices.path_ms(),
      row.by_vertices.path_ms() / row.close.path_ms(), row.apart_mm, row.ready_s, row.model_s,
      row.mobility_s, row.refusal_s);
  for (const Followed* all : {&row.nodes, &row.nodes_in_lanes, &row.close, &row.close_in_lanes,
                              &row.eigen, &row.by_vertices}) {
    if (all->to_the_end != all->paths) {
      std::printf("%d of %d paths came to the end\n", all->to_the_end, all->paths);
    }
  }
  std::fflush(stdout);
}

void print_exponents(const Row& a, const Row& b) {
  const double sizes = std::log(static_cast<double>(b.unknowns) / a.unknowns);
  const auto exponent = [&](double x, double y) { return std::log(y / x) / sizes; };
  std::printf("from %d x %d to %d x %d, power of the unknowns: operations %.2f, slots %.2f, ",
              a.panels, a.panels, b.panels, b.panels,
              exponent(static_cast<double>(a.operations), static_cast<double>(b.operations)),
              exponent(a.slots, b.slots));
  std::printf(
      "function %.2f, in lanes %.2f, close steps %.2f, in lanes %.2f, SparseLU %.2f, "
      "vertices %.2f\n",
      exponent(a.nodes.path_ms(), b.nodes.path_ms()),
      exponent(a.nodes_in_lanes.path_ms(), b.nodes_in_lanes.path_ms()),
      exponent(a.close.path_ms(), b.close.path_ms()),
      exponent(a.close_in_lanes.path_ms(), b.close_in_lanes.path_ms()),
      exponent(a.eigen.path_ms(), b.eigen.path_ms()),
      exponent(a.by_vertices.path_ms(), b.by_vertices.path_ms()));
}

int run(int argc, char** argv) {
  int rounds = 3;
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--rounds") == 0 && k + 1 < argc) {
      rounds = std::atoi(argv[++k]);
    } else {
      sizes.push_back(std::atoi(argv[k]));
    }
  }
  if (sizes.empty()) sizes = {10, 14, 20, 28, 40, 56, 70};
  std::printf(
      "| panels | unknowns | multiplications | slots | iterations as a function | in close steps | "
      "function, ms | function in lanes, ms | close steps, ms | close in lanes, ms | "
      "SparseLU, ms | SparseLU / close | / in lanes | vertices, ms | vertices / close | apart, mm "
      "| order, s | "
      "model, s | mobility, s | refusal, s |\n");
  std::vector<Row> rows;
  for (const int panels : sizes) print(rows.emplace_back(measure(panels, rounds)));
  print_exponents(rows.front(), rows.back());
  return 0;
}

}  // namespace
}  // namespace misalign::bench

int main(int argc, char** argv) { return misalign::bench::run(argc, argv); }
