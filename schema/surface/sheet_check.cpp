#include "schema/surface/sheet_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/BVH>
#include <utility>

namespace misalign::schema {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Extent in x or y. Sheets of fewer millimetres are not folded; metres and inches look like this.
constexpr double kLeast_mm = 5, kMost_mm = 1e5;
// Height of a triangle over its longest side below which its slope is not known: coordinates in
// single precision are right to 1e-7 of the mesh's size.
constexpr double kSliver = 1e-5;

std::string place(const Vector3d& mm) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", mm.x(), mm.y(), mm.z());
}

// Sets that are joined.
class Groups {
 public:
  explicit Groups(Index count) : above_(static_cast<std::size_t>(count)) {
    std::iota(above_.begin(), above_.end(), 0);
  }
  int of(int x) {
    while (above(x) != x) x = above(x) = above(above(x));
    return x;
  }
  void join(int a, int b) { above(of(a)) = of(b); }

 private:
  int& above(int x) { return above_[static_cast<std::size_t>(x)]; }
  std::vector<int> above_;
};

class SheetCheck {
 public:
  SheetCheck(const TriangleMesh& mesh, InputFaults& faults) : mesh_(mesh), faults_(faults) {
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
      for (int k = 0; k < 3; ++k)
        edges_[std::minmax(corner(t, k), corner(t, k + 1))].push_back({t, k});
    }
  }

  void find_faults() {
    check_size();
    if (!check_edges()) return;
    if (check_parts()) check_rims();
    if (check_slopes()) check_heights();
  }

 private:
  struct Side {
    int triangle, number;
  };

  int corner(int t, int k) const { return mesh_.triangles(k % 3, t); }
  Vector3d corner_mm(int t, int k) const { return mesh_.vertices_mm.col(corner(t, k)); }
  Vector3d middle_mm(int t) const {
    return mesh_.vertices_mm(Eigen::all, mesh_.triangles.col(t)).rowwise().mean();
  }

  void check_size() {
    const Vector3d size_mm =
        mesh_.vertices_mm.rowwise().maxCoeff() - mesh_.vertices_mm.rowwise().minCoeff();
    const double least_mm = size_mm.head<2>().minCoeff();
    if (least_mm >= kLeast_mm && size_mm.maxCoeff() <= kMost_mm) return;
    faults_.add(fmt::format("the mesh is {:.4g} mm wide in x, {:.4g} in y and {:.4g} in z",
                            size_mm.x(), size_mm.y(), size_mm.z()),
                fmt::format("x and y must be at least {:g}, all at most {:g}", kLeast_mm, kMost_mm),
                "scale it to millimetres, and turn it so that z is up");
  }

  bool check_edges() {
    FaultKind crowded;
    bool is_right = true;
    for (const auto& [ends, sides] : edges_) {
      if (sides.size() <= 2) continue;
      is_right = false;
      crowded.see([&, &ends = ends] {
        return fmt::format("the edge from {} to {}", place(mesh_.vertices_mm.col(ends.first)),
                           place(mesh_.vertices_mm.col(ends.second)));
      });
    }
    crowded.report("belongs to more than two triangles",
                   "keep one side of each: the surface is a single layer", faults_);
    return is_right;
  }

  bool check_parts() {
    Groups parts(mesh_.triangles.cols());
    for (const auto& [ends, sides] : edges_) {
      if (sides.size() == 2) parts.join(sides[0].triangle, sides[1].triangle);
    }
    std::map<int, int> sizes;
    for (int t = 0; t < mesh_.triangles.cols(); ++t) ++sizes[parts.of(t)];
    if (sizes.size() == 1) return true;
    faults_.add(fmt::format("the mesh has {} parts without a common edge, one of them at {}",
                            sizes.size(), place(middle_mm(sizes.begin()->first))),
                "a sheet lies on one", "join vertices that are close, or remove all but one part");
    return false;
  }

  void check_rims() {
    Groups rims(mesh_.vertices_mm.cols());
    std::vector<int> on_rim;
    for (const auto& [ends, sides] : edges_) {
      if (sides.size() != 1) continue;
      rims.join(ends.first, ends.second);
      on_rim.push_back(ends.first);
    }
    if (on_rim.empty()) {
      return faults_.add("the mesh", "is closed, like the skin of a body",
                         "keep the side on which the sheet shall lie");
    }
    std::map<int, Eigen::AlignedBox3d> boxes;
    for (const int v : on_rim) boxes[rims.of(v)].extend(mesh_.vertices_mm.col(v));
    if (boxes.size() == 1) return;
    const auto extent_mm = [](const auto& rim) { return rim.second.diagonal().norm(); };
    const auto outer = std::ranges::max_element(boxes, {}, extent_mm);
    FaultKind holes;
    for (auto rim = boxes.begin(); rim != boxes.end(); ++rim) {
      if (rim == outer) continue;
      holes.see([&] {
        return fmt::format("the hole at {}, {:.3g} mm wide,", place(rim->second.center()),
                           extent_mm(*rim));
      });
    }
    holes.report("leaves vertices of a sheet without a place", "fill it", faults_);
  }

  // Twice the area in the plane, with the sign of its turn; none of a sliver.
  std::optional<double> area_mm2(int t) const {
    const Vector3d a = corner_mm(t, 1) - corner_mm(t, 0), b = corner_mm(t, 2) - corner_mm(t, 0);
    const double longest_mm2 = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    const Vector3d normal = a.cross(b);
    if (normal.norm() < kSliver * longest_mm2) return std::nullopt;
    const bool is_steep =
        std::abs(normal.z()) < std::cos(kSteepest_deg * std::numbers::pi / 180) * normal.norm();
    return is_steep ? 0 : normal.z();
  }

  bool check_slopes() {
    FaultKind steep, folded;
    bool is_right = true;
    std::vector<std::optional<double>> areas_mm2;
    for (int t = 0; t < mesh_.triangles.cols(); ++t) {
      areas_mm2.push_back(area_mm2(t));
      if (areas_mm2.back() != 0.0) continue;
      is_right = false;
      steep.see([&] { return "the triangle at " + place(middle_mm(t)); });
    }
    for (const auto& [ends, sides] : edges_) {
      if (sides.size() != 2) continue;
      const auto &first = areas_mm2[static_cast<std::size_t>(sides[0].triangle)],
                 &second = areas_mm2[static_cast<std::size_t>(sides[1].triangle)];
      const double turn =
          corner(sides[0].triangle, sides[0].number) == corner(sides[1].triangle, sides[1].number)
              ? -1
              : 1;
      if (!first || !second || turn * *first * *second >= 0) continue;
      is_right = false;
      folded.see([&, &ends = ends] {
        return "the mesh at " +
               place((mesh_.vertices_mm.col(ends.first) + mesh_.vertices_mm.col(ends.second)) / 2);
      });
    }
    steep.report(fmt::format("is as steep as {:g} deg", kSteepest_deg),
                 "turn the mesh so that z is up, and remove walls", faults_);
    folded.report("folds back under itself",
                  "turn the mesh so that z is up, and remove what lies under or over the surface",
                  faults_);
    return is_right;
  }

  // A spiral stair is above itself without folding back.
  void check_heights() {
    std::vector<int> all(static_cast<std::size_t>(mesh_.triangles.cols()));
    std::iota(all.begin(), all.end(), 0);
    std::vector<Eigen::AlignedBox2d> boxes(all.size());
    for (const int t : all) {
      for (int k = 0; k < 3; ++k)
        boxes[static_cast<std::size_t>(t)].extend(corner_mm(t, k).head<2>());
    }
    const Eigen::KdBVH<double, 2, int> tree(all.begin(), all.end(), boxes.begin(), boxes.end());
    FaultKind twice;
    for (const int t : all) {
      Covering covering{*this, middle_mm(t).head<2>()};
      Eigen::BVIntersect(tree, covering);
      if (covering.count > 1) twice.see([&] { return "the place under " + place(middle_mm(t)); });
    }
    twice.report("has two heights", "remove what lies under or over the surface", faults_);
  }

  struct Covering {
    bool intersectVolume(const Eigen::AlignedBox2d& box) const { return box.contains(at_mm); }
    bool intersectObject(int t) {
      if (check.is_over(t, at_mm)) ++count;
      return false;
    }
    const SheetCheck& check;
    Vector2d at_mm;
    int count = 0;
  };

  bool is_over(int t, const Vector2d& at_mm) const {
    bool is_left = true, is_right = true;
    for (int k = 0; k < 3; ++k) {
      const Vector2d side = (corner_mm(t, k + 1) - corner_mm(t, k)).head<2>(),
                     away = at_mm - corner_mm(t, k).head<2>();
      const double turn = side.x() * away.y() - side.y() * away.x();
      is_left = is_left && turn > 0;
      is_right = is_right && turn < 0;
    }
    return is_left || is_right;
  }

  const TriangleMesh& mesh_;
  InputFaults& faults_;
  std::map<std::pair<int, int>, std::vector<Side>> edges_;
};

}  // namespace

void find_sheet_faults(const TriangleMesh& mesh, InputFaults& faults) {
  SheetCheck(mesh, faults).find_faults();
}

}  // namespace misalign::schema
