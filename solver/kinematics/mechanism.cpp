#include "solver/kinematics/mechanism.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Collects joints and loops while walking over the sheet.
class Builder {
 public:
  explicit Builder(const PerforatedSheet& base)
      : sheet_(base.sheet), is_hole_(base.sheet.facet_count(), false) {
    for (const int f : base.holes) is_hole_[f] = true;
    mechanism_.edges = sheet_.edges;
    mechanism_.vertices = sheet_.vertex_count();
    mechanism_.panel_width_mm = sheet_.panel_width_mm;
    mechanism_.side = base.folding.side();
    mechanism_.springs = base.springs;
    add_creases(base.folding);
    for (const int v : interior_vertices(sheet_)) add_ball_or_vertex_loop(v);
    for (const int f : base.holes) add_hole_loop(f);
    number_unknowns();
  }

  Mechanism take() { return std::move(mechanism_); }

 private:
  void add_creases(const BaseFolding& folding) {
    crease_of_edge_.assign(sheet_.edges.size(), -1);
    mechanism_.pilot = -1;
    for (int e = 0; e < static_cast<int>(sheet_.edges.size()); ++e) {
      const Edge& edge = sheet_.edges[e];
      if (edge.on_perimeter() || is_hole_[edge.left] || is_hole_[edge.right]) continue;
      crease_of_edge_[e] = static_cast<int>(mechanism_.creases.size());
      if (e == folding.pilot_edge()) mechanism_.pilot = crease_of_edge_[e];
      mechanism_.creases.push_back(
          {e, edge.a, edge.b, edge.left, edge.right, folding.assignment()[e], 0});
    }
    assert(mechanism_.pilot >= 0);
  }

  void add_ball_or_vertex_loop(int vertex) {
    const std::vector<int> ring = facets_around(sheet_, vertex);
    assert(ring.size() == 4);
    const auto open = std::count_if(ring.begin(), ring.end(), [&](int f) { return is_hole_[f]; });
    if (open == 2) {
      const int first_kept = is_hole_[ring[0]] ? 1 : 0;
      const int from = ring[first_kept], across = ring[first_kept + 1];
      const int to = ring[(first_kept + 2) % 4];
      ball_of_vertex_.resize(sheet_.vertex_count(), -1);
      ball_of_vertex_[vertex] = static_cast<int>(mechanism_.balls.size());
      mechanism_.balls.push_back(
          {vertex, from, to, {crossing(from, across, vertex), crossing(across, to, vertex)}, 0});
    } else if (open == 0) {
      Loop loop = open_loop(3, -1);
      for (int k = 0; k < 4; ++k) {
        loop.passages.push_back(over_crease(ring[k], ring[(k + 1) % 4], vertex));
      }
      close_loop(std::move(loop));
    }
  }

  // Walks counter-clockwise round the hole, from the neighbour before corner 0 back to it.
  void add_hole_loop(int hole) {
    Loop loop = open_loop(6, hole);
    loop.corners = sheet_.facets[hole];
    std::array<int, 4> neighbour{};
    for (int k = 0; k < 4; ++k) {
      const Edge& edge =
          sheet_.edges[find_edge(sheet_, loop.corners[k], loop.corners[(k + 1) % 4])];
      neighbour[k] = edge.left == hole ? edge.right : edge.left;
    }
    for (int k = 0; k < 4; ++k) {
      const int vertex = loop.corners[k];
      const int from = neighbour[(k + 3) % 4], to = neighbour[k];
      loop.arrival[k] = static_cast<int>(loop.passages.size());
      const std::vector<int> ring = facets_around(sheet_, vertex);
      const auto at = std::find(ring.begin(), ring.end(), hole) - ring.begin();
      const int opposite = ring[(at + 2) % 4];
      assert(at < 4 && ring.size() == 4);
      if (is_hole_[opposite]) {
        const int ball = ball_of_vertex_[vertex];
        assert(ball >= 0);
        const int sense = mechanism_.balls[ball].from_facet == from ? 1 : -1;
        loop.passages.push_back({true, ball, sense, vertex});
        loop.carriers[k] = carrier(loop, k, {from, to}, 0);
      } else {
        loop.passages.push_back(over_crease(from, opposite, vertex));
        loop.passages.push_back(over_crease(opposite, to, vertex));
        loop.carriers[k] = carrier(loop, k, {from, opposite, to}, 1);
      }
    }
    const int index = static_cast<int>(mechanism_.loops.size());
    for (const auto& [from, to] : {std::pair(1, 3), std::pair(2, 0)}) {
      mechanism_.diagonals.push_back({index, from, to, loop.corners[from], loop.corners[to]});
    }
    close_loop(std::move(loop));
  }

  // Returns the carrier at a corner whose facets the walk passes in the order of `passed`. If the
  // spring ends on the vertex, any of them may carry it: it is that from which the walk comes.
  Loop::Carrier carrier(const Loop& loop, int corner, const std::vector<int>& passed,
                        int usual) const {
    const SpringEnds& springs = mechanism_.springs;
    const int vertex = loop.corners[corner];
    const auto placed = std::find_if(
        springs.own.begin(), springs.own.end(),
        [&](const SpringEnds::Own& end) { return end.hole == loop.hole && end.vertex == vertex; });
    const bool is_placed = placed != springs.own.end();
    const int facet = is_placed ? placed->panel : passed[usual];
    const auto steps = std::find(passed.begin(), passed.end(), facet) - passed.begin();
    assert(steps < static_cast<std::ptrdiff_t>(passed.size()));
    const int arrival =
        loop.arrival[corner] + (springs.at_vertices() ? 0 : static_cast<int>(steps));
    const std::array<int, 4>& around = sheet_.facets[facet];
    const auto k = std::find(around.begin(), around.end(), vertex) - around.begin();
    const Eigen::Vector3d usual_mm(springs.inset_mm, 0, springs.offset_mm);
    return {facet, around[(k + 3) % 4], around[(k + 1) % 4], arrival,
            is_placed ? placed->place_mm : usual_mm};
  }

  // The edge between two facets that meet at `vertex`, crossed from one to the other.
  BallJoint::Crossing crossing(int from, int to, int vertex) const {
    for (const int other : sheet_.facets[from]) {
      const int e = find_edge(sheet_, vertex, other);
      if (e < 0) continue;
      const Edge& edge = sheet_.edges[e];
      if (edge.left == from && edge.right == to) return {e, 1};
      if (edge.right == from && edge.left == to) return {e, -1};
    }
    assert(false && "facets that meet at a vertex of degree four share an edge there");
    return {-1, 0};
  }

  Passage over_crease(int from, int to, int vertex) const {
    const BallJoint::Crossing over = crossing(from, to, vertex);
    assert(crease_of_edge_[over.edge] >= 0);
    return {false, crease_of_edge_[over.edge], over.sense, vertex};
  }

  Loop open_loop(int rows, int hole) const {
    return {{}, mechanism_.equations, rows, hole, {}, {}, {}};
  }

  void close_loop(Loop loop) {
    mechanism_.equations += loop.rows;
    mechanism_.loops.push_back(std::move(loop));
  }

  void number_unknowns() {
    int column = 0;
    for (int i = 0; i < static_cast<int>(mechanism_.creases.size()); ++i) {
      if (i != mechanism_.pilot) mechanism_.creases[i].column = column++;
    }
    for (BallJoint& ball : mechanism_.balls) {
      ball.column = column;
      column += 3;
    }
    mechanism_.creases[mechanism_.pilot].column = column;
    mechanism_.unknowns = column + 1;
  }

  const CreasePattern& sheet_;
  std::vector<bool> is_hole_;
  std::vector<int> crease_of_edge_, ball_of_vertex_;
  Mechanism mechanism_{};
};

}  // namespace

Mechanism build_mechanism(const PerforatedSheet& base) { return Builder(base).take(); }

}  // namespace misalign::solver
