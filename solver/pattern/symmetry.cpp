#include "solver/pattern/symmetry.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <optional>
#include <set>

namespace misalign::solver {
namespace {

constexpr double kSamePlace_widths = 1e-9;

// Image of each vertex; none if an image is no vertex.
std::optional<std::vector<int>> mapped_vertices(const CreasePattern& sheet,
                                                const Eigen::Matrix2d& turn) {
  const Eigen::Vector2d centre = sheet.vertices_mm.rowwise().mean();
  const FlatVertices images = (turn * (sheet.vertices_mm.colwise() - centre)).colwise() + centre;
  std::vector<int> to;
  for (int v = 0; v < sheet.vertex_count(); ++v) {
    Eigen::Index nearest = 0;
    const double distance =
        (sheet.vertices_mm.colwise() - images.col(v)).colwise().squaredNorm().minCoeff(&nearest);
    if (distance > std::pow(kSamePlace_widths * sheet.panel_width_mm, 2)) return std::nullopt;
    to.push_back(static_cast<int>(nearest));
  }
  return to;
}

std::set<int> image(const std::vector<int>& vertices, const std::vector<int>& to) {
  std::set<int> places;
  for (const int v : vertices) places.insert(to[static_cast<std::size_t>(v)]);
  return places;
}

bool maps_facets(const PerforatedSheet& base, const std::vector<int>& to) {
  std::set<std::pair<std::set<int>, bool>> there, mapped;
  for (int f = 0; f < base.sheet.facet_count(); ++f) {
    const auto& corners = base.sheet.facets[static_cast<std::size_t>(f)];
    const std::vector<int> vertices(corners.begin(), corners.end());
    const bool is_hole = std::binary_search(base.holes.begin(), base.holes.end(), f);
    there.insert({{vertices.begin(), vertices.end()}, is_hole});
    mapped.insert({image(vertices, to), is_hole});
  }
  return there == mapped;
}

bool maps_creases(const PerforatedSheet& base, const std::vector<int>& to) {
  const std::vector<int>& assignment = base.folding.assignment();
  int change = 0;  // +1 if all signs are kept, -1 if all change
  for (std::size_t e = 0; e < base.sheet.edges.size(); ++e) {
    const Edge& edge = base.sheet.edges[e];
    const int other = find_edge(base.sheet, to[static_cast<std::size_t>(edge.a)],
                                to[static_cast<std::size_t>(edge.b)]);
    if (other < 0) return false;
    const int sign = assignment[e] * assignment[static_cast<std::size_t>(other)];
    if (assignment[e] == 0 && assignment[static_cast<std::size_t>(other)] == 0) continue;
    if (change == 0) change = sign;
    if (sign != change || sign == 0) return false;
  }
  return true;
}

}  // namespace

std::vector<ShiftSymmetry> shift_symmetries(const PerforatedSheet& base,
                                            const std::vector<int>& shifted) {
  assert(std::is_sorted(shifted.begin(), shifted.end()));
  std::vector<ShiftSymmetry> symmetries;
  if (!base.springs.at_vertices()) return symmetries;
  for (int which = 1; which < 8; ++which) {
    const int first = which & 1 ? -1 : 1, second = which & 2 ? -1 : 1;
    const bool swaps = which & 4;
    Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
    turn(0, swaps ? 1 : 0) = first;
    turn(1, swaps ? 0 : 1) = second;
    const auto to = mapped_vertices(base.sheet, turn);
    if (!to || image(shifted, *to) != std::set<int>(shifted.begin(), shifted.end())) continue;
    if (!maps_facets(base, *to) || !maps_creases(base, *to)) continue;
    ShiftSymmetry symmetry{std::vector<int>(2 * shifted.size()),
                           std::vector<char>(2 * shifted.size())};
    for (std::size_t k = 0; k < shifted.size(); ++k) {
      const auto at = std::lower_bound(shifted.begin(), shifted.end(),
                                       (*to)[static_cast<std::size_t>(shifted[k])]);
      const auto j = static_cast<std::size_t>(at - shifted.begin());
      assert(j < shifted.size());  // shifted vertices map to shifted vertices
      for (std::size_t axis = 0; axis < 2; ++axis) {
        symmetry.from[2 * j + axis] = static_cast<int>(2 * k + (swaps ? 1 - axis : axis));
        symmetry.negated[2 * j + axis] = (axis == 0 ? first : second) < 0;
      }
    }
    symmetries.push_back(std::move(symmetry));
  }
  return symmetries;
}

}  // namespace misalign::solver
