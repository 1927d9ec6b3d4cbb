#include "schema/pattern/fold_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "schema/files/json_values.hpp"
#include "schema/pattern/fold_frames.hpp"
#include "schema/pattern/fold_units.hpp"
#include "schema/pattern/plane_mesh.hpp"
#include "schema/pattern/sheet_places.hpp"
#include "schema/pattern/sheet_plane.hpp"

namespace misalign::schema {
namespace {

constexpr double kMostCoordinate_mm = 1e6;
// Largest distance from the plane, in median edges. Coordinates of 80 mm panels in steps of 0.1 mm
// keep to it, and laying such an edge flat shortens it by at most 8e-6 of its length.
constexpr double kOffPlane = 2e-3;
// A sheet no larger than the unit square with room for its zigzags has no scale.
constexpr double kUnitSheet = 2;

// Reads in stages; a stage that finds faults is the last.
class Reader {
 public:
  Reader(const Json& value, std::string where, std::optional<double> mm_per_unit,
         InputFaults& faults)
      : frame_(crease_pattern_frame(value)),
        value_(frame_ ? frame_->frame : value),
        mm_per_unit_(mm_per_unit.value_or(1)),
        has_unit_(mm_per_unit.has_value()),
        faults_(std::move(where), faults) {}

  FoldMesh read() {
    if (!value_.is_object()) {
      add("the mesh", "must be a FOLD object", "write {\"vertices_coords\": ...}");
      return {};
    }
    if (frame_) say("the crease pattern is frame {} of file_frames", frame_->number);
    using Stage = void (Reader::*)();
    for (const Stage stage : {&Reader::read_unit, &Reader::read_vertices, &Reader::read_edges,
                              &Reader::read_faces, &Reader::lay_flat, &Reader::check_scale}) {
      faults_.next_kind();
      (this->*stage)();
      if (faults_.any()) return {};
    }
    auto sheet = fill_sheet(mesh_, faults_);
    return sheet ? assigned(std::move(*sheet)) : FoldMesh{};
  }

 private:
  void add(const std::string& problem, const std::string& why, const std::string& suggestion) {
    faults_.add(problem, why, suggestion);
  }
  template <class... Values>
  void say(fmt::format_string<Values...> sentence, Values&&... values) {
    reading_.push_back(fmt::format(sentence, std::forward<Values>(values)...));
  }
  int vertex_count() const { return static_cast<int>(points_mm_.size()); }

  const Json* list(const char* key) {
    const auto at = value_.find(key);
    if (at != value_.end() && at->is_array() && !at->empty()) return &*at;
    add(key, at == value_.end() ? "is missing" : "must be a list that is not empty",
        "write vertices_coords and edges_vertices (faces_vertices and edges_assignment may be left "
        "out)");
    return nullptr;
  }

  // Reads a list of `count` vertices of the file; none if it is something else.
  std::optional<std::vector<int>> vertex_list(const Json& value, std::size_t count) const {
    if (!value.is_array() || value.size() != count) return std::nullopt;
    std::vector<int> vertices;
    for (const Json& v : value) {
      if (!v.is_number_integer()) return std::nullopt;
      const auto number = v.get<double>();
      if (!(number >= 0 && number < vertex_count())) return std::nullopt;
      vertices.push_back(static_cast<int>(number));
    }
    return vertices;
  }

  void read_unit() {
    const auto at = value_.find("frame_unit");
    if (at == value_.end()) return;
    const std::optional<double> unit_mm = mm_of_unit(*at);
    if (!unit_mm) {
      add("frame_unit = " + at->dump(), "is no unit of length known here",
          "use mm, cm, m, um, nm, in, pt or unit");
    } else {
      mm_per_unit_ *= *unit_mm;
      has_unit_ = has_unit_ || *at != "unit";
    }
  }

  void read_vertices() {
    const Json* coordinates = list("vertices_coords");
    if (!coordinates) return;
    if (coordinates->size() > 4 * kMostFaces) {
      return add("vertices_coords", "has more than " + std::to_string(4 * kMostFaces) + " vertices",
                 "take a part of the mesh");
    }
    for (const Json& point : *coordinates) {
      const std::string name = "vertex " + solver::vertex_label(vertex_count());
      const bool numbers = are_numbers(point, 2) || are_numbers(point, 3);
      Eigen::Vector3d& place_mm = points_mm_.emplace_back(0, 0, 0);
      if (!numbers) {
        add(name + " = " + point.dump().substr(0, 40), "must be two or three numbers",
            "write [x, y]");
        continue;
      }
      for (std::size_t k = 0; k < point.size(); ++k) {
        place_mm[static_cast<Eigen::Index>(k)] = mm_per_unit_ * point[k].get<double>();
      }
      if (!(place_mm.cwiseAbs().maxCoeff() <= kMostCoordinate_mm)) {
        add(name + " = " + point.dump(),
            "lies farther out than " + shown_number(kMostCoordinate_mm) + " mm",
            "give coordinates in millimetres");
      }
    }
  }

  void read_edges() {
    const Json* vertices = list("edges_vertices");
    if (!vertices) return;
    const Json none_assigned(vertices->size(), "U");
    const Json* assignments =
        value_.contains("edges_assignment") ? list("edges_assignment") : &none_assigned;
    if (!assignments) return;
    if (vertices->size() != assignments->size()) {
      return add("edges_assignment has " + std::to_string(assignments->size()) + " entries",
                 "edges_vertices has " + std::to_string(vertices->size()),
                 "write one for each edge");
    }
    for (std::size_t e = 0; e < vertices->size(); ++e) {
      const auto ends = vertex_list((*vertices)[e], 2);
      const Json& assignment = (*assignments)[e];
      if (!ends || (*ends)[0] == (*ends)[1]) {
        add("edge " + std::to_string(e) + " = " + (*vertices)[e].dump().substr(0, 40),
            "must be two vertices, 0 to " + std::to_string(vertex_count() - 1), "write [0, 1]");
        continue;
      }
      const auto key = std::minmax((*ends)[0], (*ends)[1]);
      if (!mesh_.edges.try_emplace(key, assignment.is_string() ? assignment.get<std::string>() : "")
               .second) {
        add("edge " + solver::line_label(key.first, key.second), "occurs twice", "name it once");
      }
    }
  }

  void read_faces() {
    mesh_.has_faces = value_.contains("faces_vertices");
    if (!mesh_.has_faces) return;  // faces follow from the edges
    const Json* faces = list("faces_vertices");
    if (!faces) return;
    if (faces->size() > kMostFaces) {
      return add("faces_vertices has " + std::to_string(faces->size()) + " faces",
                 "at most " + std::to_string(kMostFaces) + " are taken", "take a part of the mesh");
    }
    for (std::size_t f = 0; f < faces->size(); ++f) {
      const auto corners = vertex_list((*faces)[f], 4);
      if (!corners) {
        add("face " + std::to_string(f) + " = " + (*faces)[f].dump().substr(0, 60),
            "must be four vertices, 0 to " + std::to_string(vertex_count() - 1) +
                ": the mesh must be one of quadrilaterals",
            (*faces)[f].size() == 3 ? "join the triangles of a panel"
                                    : "give the corners in order");
        continue;
      }
      mesh_.faces.push_back({(*corners)[0], (*corners)[1], (*corners)[2], (*corners)[3]});
    }
  }

  double median_edge_mm() const {
    std::vector<double> lengths_mm;
    for (const auto& [ends, assignment] : mesh_.edges) {
      const auto [a, b] = ends;
      lengths_mm.push_back((points_mm_[a] - points_mm_[b]).norm());
    }
    return median(std::move(lengths_mm));
  }

  // Lays the sheet in its plane. A sheet across z keeps its x and y; if its faces are seen from
  // below, so are its mountains and valleys.
  void lay_flat() {
    const double edge_mm = median_edge_mm(), within_mm = kOffPlane * edge_mm;
    SheetPlane plane = plane_of(points_mm_, within_mm);
    const auto farthest = std::ranges::max_element(
        points_mm_, {}, [&](const Eigen::Vector3d& point) { return plane.off(point); });
    const double off_mm = plane.off(*farthest);
    const std::string name =
        "vertex " + solver::vertex_label(static_cast<int>(farthest - points_mm_.begin()));
    if (off_mm > within_mm) {
      return add(fmt::format("{} lies {:.3g} mm off the plane of the others", name, off_mm),
                 "a crease pattern is the flat sheet", "put folded states into file_frames");
    }
    mesh_.points_mm = plane.flat(points_mm_);
    const bool clockwise = run_clockwise();
    if (clockwise && !plane.is_the_files()) {
      plane = plane.from_behind();
      mesh_.points_mm = plane.flat(points_mm_);
    } else if (clockwise) {
      letters_side_ = -1;
      if (std::ranges::any_of(mesh_.edges, [](const auto& edge) {
            return edge.second == "M" || edge.second == "V";
          })) {
        say("its faces run clockwise, seen from below: mountains and valleys are exchanged, seen "
            "from +z");
      }
    }
    if (!plane.is_the_files() || std::abs(plane.at) > within_mm) {
      say("the mesh lies in {}", plane.name());
    }
    constexpr double kRounding = 1e-9;
    if (off_mm > kRounding * edge_mm) say("{} is laid flat by {:.3g} mm", name, off_mm);
  }

  // Returns whether all faces run clockwise in the plane. Mountains and valleys are those of one
  // side: faults if some faces run one way and some the other. A face that is not convex counts as
  // neither.
  bool run_clockwise() {
    std::vector<std::size_t> clockwise, others;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      auto corners = mesh_.faces[f];
      if (is_convex(mesh_.points_mm, corners)) others.push_back(f);
      std::ranges::reverse(corners);
      if (is_convex(mesh_.points_mm, corners)) clockwise.push_back(f);
    }
    if (clockwise.empty() || others.empty()) return !clockwise.empty();
    const bool few = clockwise.size() <= others.size();
    for (const std::size_t f : few ? clockwise : others) {
      add(face_label(mesh_.faces[f]),
          fmt::format("runs {}clockwise, others do not: mountains and valleys are those of the "
                      "side from which faces run counter-clockwise",
                      few ? "" : "counter-"),
          "list the corners of all faces the same way round");
    }
    return false;
  }

  void check_scale() {
    if (has_unit_) return;
    Eigen::Vector2d least = mesh_.points_mm[0], most = least;
    for (const Eigen::Vector2d& point : mesh_.points_mm) {
      least = least.cwiseMin(point);
      most = most.cwiseMax(point);
    }
    const Eigen::Vector2d size = most - least;
    if (size.maxCoeff() > kUnitSheet) return;
    add(fmt::format("the mesh is {:.4g} by {:.4g} units", size.x(), size.y()),
        "its unit of length is unknown",
        "write frame_unit, such as \"cm\", into the FOLD file, or name the file in a pattern that "
        "says mm_per_unit: {\"family\": \"fold\", \"file\": ..., \"mm_per_unit\": 500}");
  }

  // Returns the mesh with the mountains and valleys of its creases.
  FoldMesh assigned(solver::CreasePattern sheet) {
    const int faces = static_cast<int>(mesh_.faces.size());
    FoldMesh mesh{std::move(sheet), {}, {}, std::move(reading_)};
    mesh.assignment.assign(mesh.sheet.edges.size(), 0);
    faults_.next_kind();
    for (std::size_t e = 0; e < mesh.sheet.edges.size(); ++e) {
      const solver::Edge& edge = mesh.sheet.edges[e];
      if (edge.on_perimeter()) continue;
      const std::string& assignment = mesh_.edges.at({edge.a, edge.b});
      const bool at_hole = edge.left >= faces || edge.right >= faces;
      if (assignment == "M" || assignment == "V") {
        mesh.assignment[e] = letters_side_ * (assignment == "V" ? 1 : -1);
      } else if (!at_hole && assignment != "U") {
        add("crease " + solver::line_label(edge.a, edge.b) +
                (assignment.empty() ? "" : " is \"" + assignment.substr(0, 8) + "\""),
            "must be a mountain or a valley", "write \"M\" or \"V\" into edges_assignment");
      }
    }
    for (int f = faces; f < mesh.sheet.facet_count(); ++f) mesh.missing.push_back(f);
    return mesh;
  }

  const std::optional<FoldFrame> frame_;
  const Json& value_;
  double mm_per_unit_;
  bool has_unit_;
  MeshFaults faults_;
  SpacePoints points_mm_;
  PlaneMesh mesh_;
  int letters_side_ = 1;  // -1: mountains and valleys are seen from -z of the sheet
  std::vector<std::string> reading_;
};

}  // namespace

FoldMesh read_fold(const Json& value, const std::string& where, std::optional<double> mm_per_unit,
                   InputFaults& faults) {
  return Reader(value, where, mm_per_unit, faults).read();
}

Json fold_json(const solver::CreasePattern& sheet, const std::vector<int>& assignment) {
  Json vertices = Json::array(), edges = Json::array(), letters = Json::array();
  for (const auto& place : sheet.vertices_mm.colwise()) vertices.push_back({place.x(), place.y()});
  for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
    edges.push_back({sheet.edges[e].a, sheet.edges[e].b});
    const char* const none = sheet.edges[e].on_perimeter() ? "B" : "U";  // "U" at holes
    letters.push_back(assignment[e] == 0 ? none : assignment[e] > 0 ? "V" : "M");
  }
  return {
      {"file_spec", 1.2},        {"frame_unit", "mm"},          {"vertices_coords", vertices},
      {"edges_vertices", edges}, {"edges_assignment", letters}, {"faces_vertices", sheet.facets}};
}

}  // namespace misalign::schema
