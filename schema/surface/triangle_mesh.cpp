#include "schema/surface/triangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace misalign::schema {
namespace {

using Eigen::Index;

/// Adds faults of a list's numbers, a sentence for each kind.
void find_list_faults(const PolygonList& list, InputFaults& faults) {
  FaultKind infinite, unknown, few;
  for (std::size_t v = 0; v < list.points_mm.size(); ++v) {
    if (!list.points_mm[v].allFinite())
      infinite.see([&] { return fmt::format("vertex {}", v + 1); });
  }
  const auto is_point = [&](int v) { return v >= 0 && v < std::ssize(list.points_mm); };
  for (std::size_t f = 0; f < list.faces.size(); ++f) {
    const auto say = [&] { return fmt::format("face {}", f + 1); };
    if (!std::ranges::all_of(list.faces[f], is_point)) unknown.see(say);
    if (list.faces[f].size() < 3) few.see(say);
  }
  const char* const again = "write the file again from the program it comes from";
  infinite.report("needs three finite numbers", again, faults);
  unknown.report(fmt::format("has a corner that is none of {} vertices", list.points_mm.size()),
                 again, faults);
  few.report("has fewer than three corners", "remove it", faults);
  if (list.faces.size() > kMostPolygons) {
    faults.add("the mesh", fmt::format("has more than {} faces", kMostPolygons),
               "simplify it, or take a part of it");
  }
}

/// Returns for each point the first in its place.
std::vector<int> first_in_place(const std::vector<Eigen::Vector3d>& points_mm) {
  const auto key = [&](int v) {
    const Eigen::Vector3d& p = points_mm[static_cast<std::size_t>(v)];
    return std::array{p.x(), p.y(), p.z()};
  };
  std::vector<int> order(points_mm.size()), first(points_mm.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, key);
  int last = -1;
  for (const int v : order) {
    if (last < 0 || key(last) != key(v)) last = v;
    first[static_cast<std::size_t>(v)] = last;
  }
  return first;
}

/// Turns a quadrilateral so that its shorter diagonal leaves the first corner.
void turn_to_shorter(const std::vector<Eigen::Vector3d>& points_mm, std::vector<int>& face) {
  const auto length_mm = [&](int a, int b) {
    return (points_mm[static_cast<std::size_t>(a)] - points_mm[static_cast<std::size_t>(b)]).norm();
  };
  if (face.size() == 4 && length_mm(face[1], face[3]) < length_mm(face[0], face[2])) {
    std::rotate(face.begin(), face.begin() + 1, face.end());
  }
}

}  // namespace

std::optional<TriangleMesh> triangle_mesh(const PolygonList& polygons, InputFaults& faults) {
  const std::size_t before = faults.count();
  find_list_faults(polygons, faults);
  if (faults.count() > before) return std::nullopt;
  const std::vector<int> first = first_in_place(polygons.points_mm);
  std::vector<std::array<int, 3>> triangles;
  for (std::vector<int> face : polygons.faces) {
    for (int& v : face) v = first[static_cast<std::size_t>(v)];
    turn_to_shorter(polygons.points_mm, face);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const std::array triangle{face[0], face[k], face[k + 1]};
      const bool is_whole =
          triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
      if (is_whole) triangles.push_back(triangle);
    }
  }
  if (triangles.empty()) {
    faults.add("the mesh", "has no triangles", "export the surface with its faces");
    return std::nullopt;
  }
  TriangleMesh mesh{Eigen::Matrix3Xd(3, polygons.points_mm.size()),
                    Eigen::Matrix3Xi(3, triangles.size())};
  std::vector<int> numbers(polygons.points_mm.size(), -1);
  int count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangles[t][k]);
      if (numbers[v] < 0) {
        numbers[v] = count++;
        mesh.vertices_mm.col(numbers[v]) = polygons.points_mm[v];
      }
      mesh.triangles(static_cast<Index>(k), static_cast<Index>(t)) = numbers[v];
    }
  }
  mesh.vertices_mm.conservativeResize(3, count);
  return mesh;
}

}  // namespace misalign::schema
