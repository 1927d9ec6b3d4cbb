#include "tests/bench/work_precision/level.hpp"

#include <memory>
#include <numeric>

namespace misalign::bench {
namespace {

std::vector<int> every_vertex(const Problem& problem) {
  std::vector<int> vertices(static_cast<std::size_t>(problem.mechanism().vertices));
  std::iota(vertices.begin(), vertices.end(), 0);
  return vertices;
}

template <class T>
Run jumping(const Problem& problem, const Demand& demand) {
  auto jumps = std::make_shared<LevelJumps<T>>(problem, demand);
  return [jumps](std::vector<Track>& tracks) { jumps->follow(tracks); };
}

}  // namespace

LevelProblem::LevelProblem(const Problem& problem, const Demand& demand)
    : model_(problem.base(), every_vertex(problem), {}, 0),
      sheets_{{}, static_cast<int>(problem.sheets().size())} {
  for (int deg = demand.spacing_deg; deg <= kEnd_deg; deg += demand.spacing_deg) {
    places_.push_back(model_.test_at(deg));
  }
  for (const Sheet& sheet : problem.sheets()) {
    const Eigen::Matrix2Xd shifts_mm = sheet.vertices_mm - problem.base().sheet.vertices_mm;
    sheets_.shifts_mm.insert(sheets_.shifts_mm.end(), shifts_mm.data(),
                             shifts_mm.data() + shifts_mm.size());
  }
}

Run levels_one_by_one(const Problem& problem, const Demand& demand) {
  return jumping<double>(problem, demand);
}

Run levels_in_single_precision(const Problem& problem, const Demand& demand) {
  return jumping<float>(problem, demand);
}

}  // namespace misalign::bench
