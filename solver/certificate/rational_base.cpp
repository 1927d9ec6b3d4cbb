#include "solver/certificate/rational_base.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace misalign::solver {
namespace {

using Kind = ProofGap::Kind;

class Rounder {
 public:
  explicit Rounder(const PerforatedSheet& base) : base_(base), sheet_(base.sheet) {}

  RationalBase round() {
    round_vertices();
    for (const int v : interior_vertices(sheet_)) {
      if (rounded_.gap.kind == Kind::none && !add_vertex(v)) rounded_.gap = {Kind::no_mirror, v};
    }
    if (rounded_.gap.kind == Kind::none) fold();
    return std::move(rounded_);
  }

 private:
  // A vertex' creases: two in line, and two that are mirror images about that line.
  struct MirrorVertex {
    int vertex;
    std::array<int, 2> straight, mirrored;  // edges
    Rational cosine_sq;                     // cos^2 of the sector angles
  };

  RationalVector between(int from, int to) const {
    return rounded_.vertices_mm[static_cast<std::size_t>(to)] -
           rounded_.vertices_mm[static_cast<std::size_t>(from)];
  }
  RationalVector along(int vertex, int edge) const {
    const Edge& e = sheet_.edges[static_cast<std::size_t>(edge)];
    return between(vertex, e.a == vertex ? e.b : e.a);
  }

  // Adds rounded edges from A1 on: equal edges stay equal.
  void round_vertices() {
    const auto rounded = [&](int from, int to) {
      const Eigen::Vector2d edge = sheet_.vertices_mm.col(to) - sheet_.vertices_mm.col(from);
      const Eigen::Vector2d grid = (edge / kProofGrid_mm).array().round() * kProofGrid_mm;
      rounded_.off_mm = std::max(rounded_.off_mm, (grid - edge).cwiseAbs().maxCoeff());
      return RationalVector{Rational(grid.x()), Rational(grid.y())};
    };
    std::vector<std::optional<RationalVector>> at(static_cast<std::size_t>(sheet_.vertex_count()));
    at.front() = RationalVector{};
    std::vector<int> waiting = {0};
    while (!waiting.empty()) {
      const int v = waiting.back();
      waiting.pop_back();
      for (const Edge& edge : sheet_.edges) {
        if (edge.a != v && edge.b != v) continue;
        const int other = edge.a == v ? edge.b : edge.a;
        auto& there = at[static_cast<std::size_t>(other)];
        if (there) continue;
        there = *at[static_cast<std::size_t>(v)] + rounded(v, other);
        waiting.push_back(other);
      }
    }
    for (const auto& vertex : at) rounded_.vertices_mm.push_back(*vertex);
    for (std::size_t f = 0; f < sheet_.facets.size(); ++f) {
      const auto& corners = sheet_.facets[f];
      for (std::size_t k = 0; k < 4; ++k) {
        const int from = corners[k], to = corners[(k + 1) % 4];
        if (between(from, to) == rounded(from, to)) continue;
        rounded_.gap = {Kind::open_panel, static_cast<int>(f)};
      }
    }
  }

  bool add_vertex(int vertex) {
    std::vector<int> edges;
    for (std::size_t e = 0; e < sheet_.edges.size(); ++e) {
      if (sheet_.edges[e].a == vertex || sheet_.edges[e].b == vertex) {
        edges.push_back(static_cast<int>(e));
      }
    }
    if (edges.size() != 4) return false;
    const auto sign = [&](int e) {
      return base_.folding.assignment()[static_cast<std::size_t>(e)];
    };
    do {
      const RationalVector u = along(vertex, edges[0]), back = along(vertex, edges[1]);
      const RationalVector k = along(vertex, edges[2]), l = along(vertex, edges[3]);
      const bool in_line = cross(u, back) == 0 && dot(u, back) < 0;
      const bool in_mirror = cross(u, k) * dot(u, l) == -cross(u, l) * dot(u, k) &&
                             dot(u, k) * dot(u, l) > 0 && cross(u, k) != 0;
      if (!in_line || !in_mirror) continue;
      if (sign(edges[0]) != -sign(edges[1]) || sign(edges[2]) != sign(edges[3])) return false;
      vertices_.push_back({vertex,
                           {edges[0], edges[1]},
                           {edges[2], edges[3]},
                           dot(u, k) * dot(u, k) / (dot(u, u) * dot(k, k))});
      return true;
    } while (std::next_permutation(edges.begin(), edges.end()));
    return false;
  }

  // Folds vertex after vertex from the pilot: all four creases follow from one, and must agree with
  // those known.
  void fold() {
    std::vector<std::optional<Rational>> known(sheet_.edges.size());
    known[static_cast<std::size_t>(base_.folding.pilot_edge())] = Rational(1);
    const auto value_of = [&](int e) -> std::optional<Rational>& {
      return known[static_cast<std::size_t>(e)];
    };
    std::vector<const MirrorVertex*> waiting;
    for (const MirrorVertex& vertex : vertices_) waiting.push_back(&vertex);
    const auto follow = [&](const MirrorVertex* vertex) {
      std::optional<Rational> mirrored;
      for (const int e : vertex->mirrored) {
        if (value_of(e)) mirrored = *value_of(e);
      }
      for (const int e : vertex->straight) {
        if (value_of(e)) mirrored = Rational(*value_of(e) / vertex->cosine_sq);
      }
      if (!mirrored) return false;
      const Rational straight = *mirrored * vertex->cosine_sq;
      for (std::size_t k = 0; k < 2; ++k) {
        const Rational& known_mirrored =
            value_of(vertex->mirrored[k])
                .emplace(value_of(vertex->mirrored[k]).value_or(*mirrored));
        const Rational& known_straight =
            value_of(vertex->straight[k]).emplace(value_of(vertex->straight[k]).value_or(straight));
        if (known_mirrored != *mirrored || known_straight != straight)
          rounded_.gap = {Kind::other_folding, vertex->vertex};
      }
      return true;
    };
    while (std::erase_if(waiting, follow) > 0) continue;
    if (!waiting.empty()) rounded_.gap = {Kind::other_folding, waiting.front()->vertex};
    for (const auto& tangent_sq : known) rounded_.tangents_sq.push_back(tangent_sq.value_or(0));
  }

  const PerforatedSheet& base_;
  const CreasePattern& sheet_;
  RationalBase rounded_;
  std::vector<MirrorVertex> vertices_;
};

}  // namespace

std::string ProofGap::why(const CreasePattern& sheet) const {
  const auto facet = [&] {
    const auto& v = sheet.facets[static_cast<std::size_t>(where)];
    std::string name = vertex_label(v[0]);
    for (std::size_t k = 1; k < 4; ++k) name += "-" + vertex_label(v[k]);
    return name;
  };
  switch (kind) {
    case Kind::none:
      break;
    case Kind::open_panel:
      return "edges of the base's facet " + facet() + " do not close when they are rounded";
    case Kind::no_mirror:
      return "at " + vertex_label(where) +
             " no two creases are in line with the other two in their mirror";
    case Kind::other_folding:
      return "at " + vertex_label(where) + " fold angles do not agree with its neighbours'";
    case Kind::unlike_turns:
      return "opposite edges of the hole " + facet() + " do not fold alike";
  }
  return "";
}

RationalBase rational_base(const PerforatedSheet& base) { return Rounder(base).round(); }

}  // namespace misalign::solver
