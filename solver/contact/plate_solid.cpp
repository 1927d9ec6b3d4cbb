#include "solver/contact/plate_solid.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <map>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kOnPlane_mm = 1e-9;

PlateSolid prism_of(const PolygonCorners& outline, double thickness_mm) {
  assert(outline.cols() >= 3 && thickness_mm >= 0);
  PlateSolid prism;
  const int count = static_cast<int>(outline.cols());
  std::vector<int> below, above;
  for (const double height_mm : {-thickness_mm / 2, thickness_mm / 2}) {
    for (Index k = 0; k < count; ++k) {
      prism.vertices_mm.push_back(outline.col(k) + height_mm * Vector3d::UnitZ());
    }
  }
  for (int k = 0; k < count; ++k) {
    below.push_back(count - 1 - k);
    above.push_back(count + k);
    const int next = (k + 1) % count;
    prism.faces.push_back({k, next, count + next, count + k});
  }
  prism.faces.push_back(below);
  prism.faces.push_back(above);
  return prism;
}

// Cuts off what lies beyond the plane through `on` with this normal, and closes the cut.
void cut_off(const Vector3d& on, const Vector3d& normal, PlateSolid& solid) {
  assert(std::abs(normal.norm() - 1) < 1e-9);
  std::vector<double> beyond;
  for (const Vector3d& vertex : solid.vertices_mm) {
    const double by_mm = normal.dot(vertex - on);
    beyond.push_back(std::abs(by_mm) < kOnPlane_mm ? 0 : by_mm);
  }
  std::map<std::pair<int, int>, int> on_edges;
  const auto on_edge = [&](int from, int to) {
    const auto [at, is_new] =
        on_edges.try_emplace(std::minmax(from, to), static_cast<int>(solid.vertices_mm.size()));
    if (is_new) {
      const auto [i, k] = at->first;
      assert(beyond[static_cast<std::size_t>(i)] * beyond[static_cast<std::size_t>(k)] < 0);
      const double share =
          beyond[static_cast<std::size_t>(i)] /
          (beyond[static_cast<std::size_t>(i)] - beyond[static_cast<std::size_t>(k)]);
      const Vector3d p = solid.vertices_mm[static_cast<std::size_t>(i)],
                     q = solid.vertices_mm[static_cast<std::size_t>(k)];
      solid.vertices_mm.push_back(p + share * (q - p));
    }
    return at->second;
  };
  std::vector<std::vector<int>> faces;
  std::map<int, int> along_cut;  // edges of the cut, reversed
  for (const std::vector<int>& face : solid.faces) {
    std::vector<int> kept;
    int leaves = -1, comes_back = -1;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int vertex = face[k], next = face[(k + 1) % face.size()];
      const double at = beyond[static_cast<std::size_t>(vertex)],
                   then = beyond[static_cast<std::size_t>(next)];
      if (at <= 0) kept.push_back(vertex);
      if (at <= 0 && then > 0) {
        leaves = at < 0 ? on_edge(vertex, next) : vertex;
        if (at < 0) kept.push_back(leaves);
      } else if (at > 0 && then <= 0) {
        comes_back = then < 0 ? on_edge(vertex, next) : next;
        if (then < 0) kept.push_back(comes_back);
      }
    }
    if (leaves >= 0 && leaves != comes_back) along_cut[comes_back] = leaves;
    if (kept.size() > 2) faces.push_back(kept);
  }
  if (along_cut.size() > 2) {
    std::vector<int> cap{along_cut.begin()->first};
    for (int next = along_cut.begin()->second;
         next != cap.front() && cap.size() <= along_cut.size(); next = along_cut.at(next)) {
      cap.push_back(next);
    }
    faces.push_back(cap);
  }
  solid.faces = std::move(faces);
}

void drop_unused(PlateSolid& solid) {
  std::vector<int> number(solid.vertices_mm.size(), -1);
  std::vector<Vector3d> used;
  for (std::vector<int>& face : solid.faces) {
    for (int& vertex : face) {
      int& known = number[static_cast<std::size_t>(vertex)];
      if (known < 0) {
        known = static_cast<int>(used.size());
        used.push_back(solid.vertices_mm[static_cast<std::size_t>(vertex)]);
      }
      vertex = known;
    }
  }
  solid.vertices_mm = std::move(used);
}

}  // namespace

std::vector<PlateSolid> plate_solids(const Panels& panels, const FlatVertices& vertices_mm,
                                     double thickness_mm, double trim_mm,
                                     const std::vector<double>& largest_rad) {
  assert(largest_rad.size() == panels.folds.size());
  std::vector<PlateSolid> solids;
  for (const PolygonCorners& outline : trimmed_panels(panels, vertices_mm, trim_mm)) {
    solids.push_back(prism_of(outline, thickness_mm));
  }
  for (std::size_t k = 0; k < panels.folds.size(); ++k) {
    const FoldLine& fold = panels.folds[k];
    assert(std::abs(fold.sign) == 1 && largest_rad[k] >= 0);
    Vector3d a, b;
    a << vertices_mm.col(fold.a) - vertices_mm.col(0), 0;
    b << vertices_mm.col(fold.b) - vertices_mm.col(0), 0;
    const double bevel_rad = (kPi - largest_rad[k]) / 2;
    for (const int panel : {fold.left, fold.right}) {
      const double to_left = panel == fold.left ? 1 : -1;
      const Vector3d inwards = to_left * Vector3d::UnitZ().cross((b - a).normalized());
      cut_off(a,
              fold.sign * std::cos(bevel_rad) * Vector3d::UnitZ() - std::sin(bevel_rad) * inwards,
              solids[static_cast<std::size_t>(panel)]);
    }
  }
  for (PlateSolid& solid : solids) drop_unused(solid);
  return solids;
}

}  // namespace misalign::solver
