#include "solver/motion/filling_forces.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "solver/fill/edge_forces.hpp"

namespace misalign::solver {

FillingForces::FillingForces(const Mechanism& mechanism, const Panels& panels)
    : mechanism_(mechanism),
      panels_(panels),
      panels_at_(static_cast<std::size_t>(mechanism.vertices)) {
  for (std::size_t k = 0; k < panels.corners.size(); ++k) {
    for (const int v : panels.corners[k]) {
      panels_at_[static_cast<std::size_t>(v)].push_back(static_cast<int>(k));
    }
  }
}

std::vector<FillingForce> FillingForces::of_hole(const Filling& filling, Eigen::Index hole,
                                                 const HoleEnergy& state,
                                                 const Eigen::Matrix3Xd& vertices_mm) const {
  std::vector<FillingForce> forces;
  const Diagonal* const both = mechanism_.diagonals.data() + 2 * hole;
  if (filling.is_springs()) {
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector3d pull_n =
          state.force_n(k) *
          (vertices_mm.col(both[k].to) - vertices_mm.col(both[k].from)).normalized();
      for (const auto& [vertex, sign] : {std::pair(both[k].from, 1.0), {both[k].to, -1.0}}) {
        const auto& met = panels_at_[static_cast<std::size_t>(vertex)];
        for (const int panel : met) {
          forces.push_back(
              {panel, vertex, vertex, sign / static_cast<double>(met.size()) * pull_n});
        }
      }
    }
    return forces;
  }
  const std::array<int, 4> corners = mechanism_.hole_corners(static_cast<int>(hole));
  const auto edges_n = edge_forces_n(state, vertices_mm(Eigen::all, corners));
  const Loop& loop = mechanism_.loops[static_cast<std::size_t>(both->loop)];
  for (std::size_t k = 0; k < 4; ++k) {
    const int from = corners[k], to = corners[(k + 1) % 4];
    const auto is_this = [&](const Edge& edge) {
      return std::minmax(edge.a, edge.b) == std::minmax(from, to);
    };
    const auto edge = std::ranges::find_if(mechanism_.edges, is_this);
    assert(edge != mechanism_.edges.end());
    const int facet = edge->left == loop.hole ? edge->right : edge->left;
    forces.push_back(
        {panels_.panel_of(facet), from, to, edges_n.col(static_cast<Eigen::Index>(k))});
  }
  return forces;
}

}  // namespace misalign::solver
