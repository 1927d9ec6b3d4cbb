#include "solver/pattern/base_folding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace misalign::solver {
namespace {

// Pilot angles at which the loops are checked, as shares of the largest.
constexpr double kLookedAt[] = {0.005, 0.02, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 0.995};

constexpr double kEndStep_deg = 0.5, kEndTolerance_deg = 1e-7;

// The least open completion is taken as the intended one if the next is open by this factor more;
// with shifts of a quarter of a panel the factor is 20.
constexpr double kFarLess = 4;
constexpr double kNotKnown = std::numeric_limits<double>::infinity();

// Largest number of tried completions of an unknown assignment.
constexpr int kMostBranches = 200;

}  // namespace

// Finds each vertex' way of folding from the signs of its creases; vertices with the fewest ways
// come first.
class SequentialMethod {
 public:
  SequentialMethod(const CreasePattern& sheet, const std::vector<int>& assignment, int pilot_edge)
      : sheet_(sheet), pilot_edge_(pilot_edge) {
    side_ = assignment[pilot_edge] < 0 ? -1 : 1;
    for (const int sign : assignment) signs_.push_back(side_ * sign);
    vertex_at_.assign(sheet.vertex_count(), -1);
    for (const int v : interior_vertices(sheet)) {
      vertex_at_[v] = static_cast<int>(vertices_.size());
      vertices_.push_back({v, edges_around(v), 0});
    }
  }

  std::variant<BaseFolding, NoBaseFolding> solve() {
    branch();
    if (solutions_.size() > 1) return ambiguity();
    if (branches_ > kMostBranches)
      return NoBaseFolding{NoBaseFolding::Cause::ambiguous, branched_at_};
    if (!solutions_.empty()) return std::move(solutions_.front());
    if (unclosed_ && !(kFarLess * open_by_ < next_open_by_)) {
      return NoBaseFolding{NoBaseFolding::Cause::ambiguous, branched_at_};
    }
    failure_->unclosed = std::move(unclosed_);
    return *failure_;
  }

 private:
  struct Vertex {
    int vertex;
    std::array<int, 4> edges;  // counter-clockwise
    int way;                   // sign of opposite creases, first edge to third; 0: not chosen
  };

  // Edges that leave a vertex, counter-clockwise.
  std::array<int, 4> edges_around(int vertex) const {
    std::array<int, 4> edges{};
    const std::vector<int> ring = facets_around(sheet_, vertex);
    for (int k = 0; k < 4; ++k) {
      const auto& corners = sheet_.facets[ring[k]];
      const auto at = std::find(corners.begin(), corners.end(), vertex) - corners.begin();
      edges[k] = find_edge(sheet_, vertex, corners[(at + 1) % 4]);
    }
    return edges;
  }

  // Returns the vertex with its creases numbered from `first` on.
  DegreeFourVertex from(const Vertex& v, int first, int way) const {
    std::array<Eigen::Vector2d, 4> directions;
    for (int k = 0; k < 4; ++k) {
      const Edge& edge = sheet_.edges[v.edges[(first + k) % 4]];
      const int other = edge.a == v.vertex ? edge.b : edge.a;
      directions[k] =
          (sheet_.vertices_mm.col(other) - sheet_.vertices_mm.col(v.vertex)).normalized();
    }
    // The two ways differ in both pairs of opposite creases.
    return DegreeFourVertex(directions, first % 2 == 0 ? way : -way);
  }

  // Returns the creases' signs if the vertex folds this way; none if known signs disagree.
  std::optional<std::array<int, 4>> signs_of(const Vertex& v, int way) const {
    int first = 0;
    while (first < 4 && signs_[v.edges[first]] == 0) ++first;
    if (first == 4) return std::nullopt;
    const DegreeFourVertex folds = from(v, first, way);
    if (!folds.signs()) return std::nullopt;
    std::array<int, 4> signs{};
    signs[first] = signs_[v.edges[first]];
    for (int k = 1; k < 4; ++k) {
      const int at = (first + k) % 4, known = signs_[v.edges[at]];
      signs[at] = signs[first] * (*folds.signs())[k - 1];
      if (known != 0 && known != signs[at]) return std::nullopt;
    }
    return signs;
  }

  void choose(Vertex& v, int way, const std::array<int, 4>& signs) {
    v.way = way;
    for (int k = 0; k < 4; ++k) signs_[v.edges[k]] = signs[k];
  }

  // Fixes the vertices that have one way left, then tries both ways of a vertex that has two.
  void branch() {
    if (solutions_.size() > 1 || ++branches_ > kMostBranches) return;
    for (bool chosen = true; chosen;) {
      chosen = false;
      for (Vertex& v : vertices_) {
        if (v.way != 0 || !is_known(v)) continue;
        const auto same = signs_of(v, 1), other = signs_of(v, -1);
        if (!same && !other) {
          if (!failure_) fail(misassigned(v));
          return;
        }
        if (same && other) continue;
        choose(v, same ? 1 : -1, same ? *same : *other);
        chosen = true;
      }
    }
    const auto open = std::find_if(vertices_.begin(), vertices_.end(),
                                   [&](const Vertex& v) { return v.way == 0 && is_known(v); });
    if (open == vertices_.end()) return finish();
    branched_at_ = open->vertex;
    const auto vertices = vertices_;
    const auto signs = signs_;
    const auto at = static_cast<std::size_t>(open - vertices_.begin());
    for (const int way : {1, -1}) {
      choose(vertices_[at], way, *signs_of(vertices_[at], way));
      branch();
      vertices_ = vertices;
      signs_ = signs;
    }
  }

  NoBaseFolding misassigned(const Vertex& v) {
    NoBaseFolding failure{NoBaseFolding::Cause::assignment, v.vertex};
    NoBaseFolding::Creases creases{v.edges, {}, {}, -1};
    for (int k = 0; k < 4; ++k) creases.signs[k] = side_ * signs_[v.edges[k]];
    for (const int way : {1, -1}) {
      const auto others = from(v, 0, way).signs();
      if (!others) continue;
      const std::array<int, 4> signs = {1, (*others)[0], (*others)[1], (*others)[2]};
      const int sum = signs[0] + signs[1] + signs[2] + signs[3];
      for (int k = 0; k < 4; ++k) {
        if (signs[k] * sum < 0) creases.odd.push_back(v.edges[k]);
      }
    }
    std::vector<int> wrong;
    for (const int e : v.edges) {
      signs_[e] = -signs_[e];
      if (signs_[e] != 0 && folds_with_neighbours(v)) wrong.push_back(e);
      signs_[e] = -signs_[e];
    }
    if (wrong.size() == 1) creases.wrong = wrong.front();
    failure.creases = creases;
    return failure;
  }

  // Returns whether a vertex and its neighbours fold, each by itself.
  bool folds_with_neighbours(const Vertex& v) const {
    for (const int edge : v.edges) {
      for (const int end : {sheet_.edges[edge].a, sheet_.edges[edge].b}) {
        if (vertex_at_[end] < 0) continue;
        const Vertex& neighbour = vertices_[vertex_at_[end]];
        if (is_known(neighbour) && !signs_of(neighbour, 1) && !signs_of(neighbour, -1))
          return false;
      }
    }
    return true;
  }

  bool is_known(const Vertex& v) const {
    return std::any_of(v.edges.begin(), v.edges.end(), [&](int e) { return signs_[e] != 0; });
  }

  // Orders the vertices, all of whose ways are chosen, from the pilot, and checks that the loops
  // close.
  void finish() {
    BaseFolding folding;
    folding.pilot_edge_ = pilot_edge_;
    folding.side_ = side_;
    folding.assignment_ = signs_;
    std::vector<bool> has_angle(sheet_.edges.size(), false), done(vertices_.size(), false);
    has_angle[pilot_edge_] = true;
    std::vector<int> frontier{pilot_edge_};
    for (std::size_t next = 0; next < frontier.size(); ++next) {
      const Edge& edge = sheet_.edges[frontier[next]];
      for (const int end : {edge.a, edge.b}) {
        const int index = vertex_at_[end];
        if (index < 0 || done[index]) continue;
        done[index] = true;
        const Vertex& v = vertices_[index];
        const auto at = std::find(v.edges.begin(), v.edges.end(), frontier[next]);
        const int first = static_cast<int>(at - v.edges.begin());
        auto edges = v.edges;
        std::rotate(edges.begin(), edges.begin() + first, edges.end());
        folding.steps_.push_back({v.vertex, edges, from(v, first, v.way)});
        for (const int e : edges) {
          if (has_angle[e]) continue;
          has_angle[e] = true;
          frontier.push_back(e);
        }
      }
    }
    const auto unreached = std::find(done.begin(), done.end(), false);
    if (unreached != done.end()) {
      return fail({NoBaseFolding::Cause::unconnected, vertices_[unreached - done.begin()].vertex});
    }
    find_end(folding);
    if (const auto opening = first_opening(folding)) {
      fail(*opening);
      keep_unclosed(std::move(folding));
    } else {
      solutions_.push_back(std::move(folding));
    }
  }

  void keep_unclosed(BaseFolding folding) {
    const double open_by = open_next_to_flat(folding);
    if (unclosed_ && open_by >= open_by_) {
      next_open_by_ = std::min(next_open_by_, open_by);
      return;
    }
    next_open_by_ = std::exchange(open_by_, open_by);
    unclosed_ = std::move(folding);
  }

  static void find_end(BaseFolding& folding) {
    std::vector<HalfAngle<double>> angles;
    const auto folds = [&](double pilot_deg, double closed_rad = 0) {
      return folding.follow(half_angle_of_deg(pilot_deg), closed_rad, angles) < 0;
    };
    double good = 0, bad = kEndStep_deg;
    while (bad <= 180 && folds(bad)) good = std::exchange(bad, bad + kEndStep_deg);
    while (bad <= 180 && bad - good > kEndTolerance_deg) {
      const double middle = 0.5 * (good + bad);
      (folds(middle) ? good : bad) = middle;
    }
    if (180 - good < kEndStep_deg && folds(180, kClosed_rad)) good = 180;
    folding.end_deg_ = good;
  }

  // Returns the first crease to which its two vertices give different angles.
  std::optional<NoBaseFolding> first_opening(const BaseFolding& folding) const {
    for (const double share : kLookedAt) {
      const double pilot_deg = share * folding.end_deg_;
      const auto angles = folding.fold_angles(half_angle_of_deg(pilot_deg));
      for (const BaseFolding::Step& step : folding.steps_) {
        const auto others = step.folds.others(angles[step.edges[0]]);
        // Short of the end every vertex folds, except by rounding if the end is near flat.
        if (!others) return NoBaseFolding{NoBaseFolding::Cause::assignment, step.vertex};
        for (int k = 0; k < 3; ++k) {
          const int edge = step.edges[k + 1];
          const double angle = angle_deg((*others)[k]), other_angle = angle_deg(angles[edge]);
          if (std::abs(angle - other_angle) <= kBaseClosure * pilot_deg) continue;
          return NoBaseFolding{
              NoBaseFolding::Cause::open, step.vertex, edge, pilot_deg, angle, other_angle};
        }
      }
    }
    return std::nullopt;
  }

  // Returns the largest difference between the two angles of a crease, divided by the pilot's.
  static double open_next_to_flat(const BaseFolding& folding) {
    const double pilot_deg = kLookedAt[0] * folding.end_deg_;
    const auto angles = folding.fold_angles(half_angle_of_deg(pilot_deg));
    double open_by = 0;
    for (const BaseFolding::Step& step : folding.steps_) {
      const auto others = step.folds.others(angles[step.edges[0]]);
      if (!others) return kNotKnown;
      for (int k = 0; k < 3; ++k) {
        const double off_deg = angle_deg((*others)[k]) - angle_deg(angles[step.edges[k + 1]]);
        open_by = std::max(open_by, std::abs(off_deg) / pilot_deg);
      }
    }
    return open_by;
  }

  // Keeps the first failure, even if later branches come nearer.
  void fail(const NoBaseFolding& failure) {
    if (!failure_) failure_ = failure;
  }

  NoBaseFolding ambiguity() const {
    const auto& first = solutions_[0].assignment();
    const auto& second = solutions_[1].assignment();
    const auto at = std::mismatch(first.begin(), first.end(), second.begin()).first - first.begin();
    return {NoBaseFolding::Cause::ambiguous, branched_at_, static_cast<int>(at)};
  }

  const CreasePattern& sheet_;
  const int pilot_edge_;
  int side_, branched_at_ = -1, branches_ = 0;
  std::vector<int> signs_;      // per edge, seen from the pilot's side
  std::vector<int> vertex_at_;  // index into vertices_, per vertex of the sheet
  std::vector<Vertex> vertices_;
  std::vector<BaseFolding> solutions_;
  std::optional<NoBaseFolding> failure_;
  std::optional<BaseFolding> unclosed_;  // the least open folding
  double open_by_ = kNotKnown, next_open_by_ = kNotKnown;
};

BaseFolding::BaseFolding(int pilot_edge, int side, std::vector<int> assignment, double end_deg,
                         std::shared_ptr<const FollowedFolding> path)
    : pilot_edge_(pilot_edge),
      side_(side),
      assignment_(std::move(assignment)),
      end_deg_(end_deg),
      path_(std::move(path)) {}

int BaseFolding::follow(const HalfAngle<double>& pilot, double closed_rad,
                        std::vector<HalfAngle<double>>& angles) const {
  angles.assign(assignment_.size(), {1, 0});
  std::vector<bool> known(angles.size(), false);
  angles[pilot_edge_] = pilot;
  known[pilot_edge_] = true;
  for (const Step& step : steps_) {
    const auto others = step.folds.others(angles[step.edges[0]], closed_rad);
    if (!others) return step.vertex;
    for (int k = 0; k < 3; ++k) {
      const int edge = step.edges[k + 1];
      if (!known[edge]) angles[edge] = (*others)[k];
      known[edge] = true;
    }
  }
  return -1;
}

std::vector<HalfAngle<double>> BaseFolding::fold_angles(const HalfAngle<double>& pilot) const {
  if (path_) return path_->fold_angles(pilot);
  std::vector<HalfAngle<double>> angles;
  follow(pilot, kClosed_rad, angles);
  return angles;
}

std::variant<BaseFolding, NoBaseFolding> fold_sequentially(const CreasePattern& sheet,
                                                           const std::vector<int>& assignment,
                                                           int pilot_edge) {
  return SequentialMethod(sheet, assignment, pilot_edge).solve();
}

}  // namespace misalign::solver
