#include "schema/pattern/fold_format.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "schema/pattern/plane_mesh.hpp"

namespace misalign::schema {
namespace {

constexpr double kMostCoordinate_mm = 1e6;

using Point = Eigen::Vector2d;

// Reads in stages; a stage that finds faults is the last.
class Reader {
 public:
  Reader(const Json& value, std::string where, double mm_per_unit, InputFaults& faults)
      : value_(value), mm_per_unit_(mm_per_unit), faults_(std::move(where), faults) {}

  FoldMesh read() {
    if (!value_.is_object()) {
      add("the mesh", "must be a FOLD object", "write {\"vertices_coords\": ...}");
      return {};
    }
    using Stage = void (Reader::*)();
    for (const Stage stage :
         {&Reader::read_unit, &Reader::read_vertices, &Reader::read_edges, &Reader::read_faces}) {
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
  static std::string label(int v) { return solver::vertex_label(v); }
  int vertex_count() const { return static_cast<int>(mesh_.points_mm.size()); }

  const Json* list(const char* key) {
    const auto at = value_.find(key);
    if (at != value_.end() && at->is_array() && !at->empty()) return &*at;
    add(key, at == value_.end() ? "is missing" : "must be a list that is not empty",
        "write vertices_coords, edges_vertices and edges_assignment (faces_vertices may be left "
        "out)");
    return nullptr;
  }

  // A list of vertices of the file, as many as `count`; none if it is something else.
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
    static const std::map<std::string, double> kUnits = {
        {"unit", 1},  {"mm", 1},    {"cm", 10},       {"m", 1000},
        {"um", 1e-3}, {"in", 25.4}, {"pt", 25.4 / 72}};
    const auto at = value_.find("frame_unit");
    if (at == value_.end()) return;
    const auto unit = at->is_string() ? kUnits.find(at->get<std::string>()) : kUnits.end();
    if (unit == kUnits.end()) {
      add("frame_unit = " + at->dump(), "is no unit of length known here",
          "use mm, cm, m, um, in, pt or unit");
    } else {
      mm_per_unit_ *= unit->second;
    }
  }

  void read_vertices() {
    const Json* coordinates = list("vertices_coords");
    if (!coordinates) return;
    if (coordinates->size() > 4 * kMostFaces) {
      add("vertices_coords", "has more than " + std::to_string(4 * kMostFaces) + " vertices",
          "take a part of the mesh");
      return;
    }
    for (const Json& point : *coordinates) {
      const std::string name = "vertex " + label(vertex_count());
      const bool numbers =
          point.is_array() && (point.size() == 2 || point.size() == 3) &&
          std::all_of(point.begin(), point.end(), [](const Json& x) { return x.is_number(); });
      mesh_.points_mm.emplace_back(0, 0);
      if (!numbers) {
        add(name + " = " + point.dump().substr(0, 40), "must be two numbers", "write [x, y]");
      } else if (point.size() == 3 && point[2].get<double>() != 0) {
        add(name + " has z = " + point[2].dump(), "the key frame must be the flat sheet",
            "put folded states into file_frames");
      } else {
        mesh_.points_mm.back() =
            mm_per_unit_ * Point(point[0].get<double>(), point[1].get<double>());
        if (!(mesh_.points_mm.back().cwiseAbs().maxCoeff() <= kMostCoordinate_mm)) {
          add(name + " = " + point.dump(),
              "lies farther out than " + shown_number(kMostCoordinate_mm) + " mm",
              "give coordinates in millimetres");
        }
      }
    }
  }

  void read_edges() {
    const Json* vertices = list("edges_vertices");
    const Json* assignments = list("edges_assignment");
    if (!vertices || !assignments) return;
    if (vertices->size() != assignments->size()) {
      add("edges_assignment has " + std::to_string(assignments->size()) + " entries",
          "edges_vertices has " + std::to_string(vertices->size()), "write one for each edge");
      return;
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
        add("edge " + solver::line_label(key.first, key.second), "is there twice", "name it once");
      }
    }
  }

  void read_faces() {
    mesh_.has_faces = value_.contains("faces_vertices");
    if (!mesh_.has_faces) return;  // they follow from the edges
    const Json* faces = list("faces_vertices");
    if (!faces) return;
    if (faces->size() > kMostFaces) {
      add("faces_vertices has " + std::to_string(faces->size()) + " faces",
          "at most " + std::to_string(kMostFaces) + " are taken", "take a part of the mesh");
      return;
    }
    for (std::size_t f = 0; f < faces->size(); ++f) {
      const auto corners = vertex_list((*faces)[f], 4);
      if (!corners) {
        add("face " + std::to_string(f) + " = " + (*faces)[f].dump().substr(0, 60),
            "must be four vertices, 0 to " + std::to_string(vertex_count() - 1) +
                ": the mesh must be one of quadrilaterals",
            "give the corners in order");
        continue;
      }
      mesh_.faces.push_back({(*corners)[0], (*corners)[1], (*corners)[2], (*corners)[3]});
    }
  }

  // With the mountains and valleys of its creases.
  FoldMesh assigned(solver::CreasePattern sheet) {
    const int faces = static_cast<int>(mesh_.faces.size());
    FoldMesh mesh{std::move(sheet), {}, {}};
    mesh.assignment.assign(mesh.sheet.edges.size(), 0);
    faults_.next_kind();
    for (std::size_t e = 0; e < mesh.sheet.edges.size(); ++e) {
      const solver::Edge& edge = mesh.sheet.edges[e];
      if (edge.on_perimeter()) continue;
      const std::string& assignment = mesh_.edges.at({edge.a, edge.b});
      const bool at_hole = edge.left >= faces || edge.right >= faces;
      if (assignment == "M" || assignment == "V") {
        mesh.assignment[e] = assignment == "V" ? 1 : -1;
      } else if (!at_hole) {
        add("crease " + solver::line_label(edge.a, edge.b) +
                (assignment.empty() ? "" : " is \"" + assignment.substr(0, 8) + "\""),
            "must be a mountain or a valley", "write \"M\" or \"V\" into edges_assignment");
      }
    }
    for (int f = faces; f < mesh.sheet.facet_count(); ++f) mesh.missing.push_back(f);
    return mesh;
  }

  const Json& value_;
  double mm_per_unit_;
  MeshFaults faults_;
  PlaneMesh mesh_;
};

}  // namespace

FoldMesh read_fold(const Json& value, const std::string& where, double mm_per_unit,
                   InputFaults& faults) {
  return Reader(value, where, mm_per_unit, faults).read();
}

Json fold_json(const solver::CreasePattern& sheet, const std::vector<int>& assignment) {
  Json vertices = Json::array(), edges = Json::array(), letters = Json::array();
  for (Eigen::Index v = 0; v < sheet.vertices_mm.cols(); ++v) {
    vertices.push_back({sheet.vertices_mm(0, v), sheet.vertices_mm(1, v)});
  }
  for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
    edges.push_back({sheet.edges[e].a, sheet.edges[e].b});
    letters.push_back(assignment[e] == 0 ? "B" : assignment[e] > 0 ? "V" : "M");
  }
  return {
      {"file_spec", 1.2},        {"frame_unit", "mm"},          {"vertices_coords", vertices},
      {"edges_vertices", edges}, {"edges_assignment", letters}, {"faces_vertices", sheet.facets}};
}

}  // namespace misalign::schema
