#include "schema/fold_format.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace misalign::schema {
namespace {

constexpr std::size_t kMostFaces = 1600;  // as many as a 40 x 40 Miura-ori has
constexpr double kMostCoordinate_mm = 1e6;
constexpr double kLeastSize_mm = 1e-3;  // far above what products of coordinates underflow at
// Vertices closer than this part of the sheet's size are the same point.
constexpr double kSamePoint = 1e-7;
// So many faults of a kind are told.
constexpr int kMostOfAKind = 5;

using Quad = std::array<int, 4>;
using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

// Reads in stages; a stage that finds faults is the last.
class Reader {
 public:
  Reader(const Json& value, std::string where, double mm_per_unit, InputFaults& faults)
      : value_(value), where_(std::move(where)), mm_per_unit_(mm_per_unit), faults_(faults) {}

  FoldMesh read() {
    FoldMesh mesh;
    if (!value_.is_object()) {
      add("the document", "must be a FOLD object", "write {\"vertices_coords\": ...}");
      return mesh;
    }
    using Stage = void (Reader::*)();
    for (const Stage stage : {&Reader::read_unit, &Reader::read_vertices, &Reader::read_edges,
                              &Reader::read_faces, &Reader::check_vertices, &Reader::orient_faces,
                              &Reader::pair_edges, &Reader::check_crossings, &Reader::find_gaps,
                              &Reader::check_degrees, &Reader::place_faces}) {
      told_ = 0;
      (this->*stage)();
      if (told_ > 0) return mesh;
    }
    finish(mesh);
    return mesh;
  }

 private:
  void add(const std::string& problem, const std::string& why, const std::string& suggestion) {
    if (++told_ > kMostOfAKind) return;
    faults_.add(where_.empty() ? problem : where_ + ": " + problem, why, suggestion);
  }

  static std::string label(int v) { return solver::vertex_label(v); }
  static std::string label(const std::vector<int>& loop) {
    std::string text;
    for (const int v : loop) text += (text.empty() ? "" : "-") + label(v);
    return text;
  }
  static std::string face_label(const Quad& q) {
    return "the face " + label(std::vector<int>(q.begin(), q.end()));
  }
  int vertex_count() const { return static_cast<int>(points_.size()); }

  const Json* list(const char* key) {
    const auto at = value_.find(key);
    if (at != value_.end() && at->is_array() && !at->empty()) return &*at;
    add(key, at == value_.end() ? "is missing" : "must be a list that is not empty",
        "write vertices_coords, edges_vertices, edges_assignment and faces_vertices");
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
      points_.emplace_back(0, 0);
      if (!numbers) {
        add(name + " = " + point.dump().substr(0, 40), "must be two numbers", "write [x, y]");
      } else if (point.size() == 3 && point[2].get<double>() != 0) {
        add(name + " has z = " + point[2].dump(), "the key frame must be the flat sheet",
            "put folded states into file_frames");
      } else {
        points_.back() = mm_per_unit_ * Point(point[0].get<double>(), point[1].get<double>());
        if (!(points_.back().cwiseAbs().maxCoeff() <= kMostCoordinate_mm)) {
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
      if (!edges_.try_emplace(key, assignment.is_string() ? assignment.get<std::string>() : "")
               .second) {
        add("edge " + solver::line_label(key.first, key.second), "is there twice", "name it once");
      }
    }
  }

  void read_faces() {
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
      faces_.push_back({(*corners)[0], (*corners)[1], (*corners)[2], (*corners)[3]});
    }
  }

  void check_vertices() {
    double size = 0;
    for (const Point& p : points_) size = std::max(size, (p - points_[0]).cwiseAbs().maxCoeff());
    if (!(size >= kLeastSize_mm)) {
      add("the mesh", "is smaller than " + shown_number(kLeastSize_mm) + " mm",
          "say how long a unit is in frame_unit or mm_per_unit");
      return;
    }
    std::vector<int> order(points_.size());
    for (int v = 0; v < vertex_count(); ++v) order[v] = v;
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::pair(points_[a].x(), a) < std::pair(points_[b].x(), b);
    });
    for (std::size_t i = 0; i < order.size() && told_ < kMostOfAKind; ++i) {
      for (std::size_t k = i + 1; k < order.size() && told_ < kMostOfAKind; ++k) {
        const Point apart = points_[order[k]] - points_[order[i]];
        if (apart.x() > kSamePoint * size) break;
        if (std::abs(apart.y()) > kSamePoint * size) continue;
        const auto [a, b] = std::minmax(order[i], order[k]);
        add("vertices " + label(a) + " and " + label(b), "are the same point",
            "join them into one vertex");
      }
    }
    std::vector<bool> used(points_.size(), false);
    for (const Quad& q : faces_) {
      for (const int v : q) used[v] = true;
    }
    for (int v = 0; v < vertex_count(); ++v) {
      if (!used[v]) add("vertex " + label(v), "belongs to no face", "take it out");
    }
  }

  void orient_faces() {
    for (Quad& q : faces_) {
      const auto corner = [&](int k) { return points_[q[k % 4]]; };
      if (cross(corner(2) - corner(0), corner(3) - corner(1)) < 0) std::reverse(q.begin(), q.end());
      for (int k = 0; k < 4; ++k) {
        if (cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1)) > 0) continue;
        add(face_label(q), "is no convex quadrilateral",
            "give its corners in order, no three on a line");
        break;
      }
    }
  }

  // Every side of a face is an edge of the file, with one face at most on each of its sides.
  void pair_edges() {
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      for (int k = 0; k < 4; ++k) {
        const std::pair side(faces_[f][k], faces_[f][(k + 1) % 4]);
        if (!edges_.contains(std::minmax(side.first, side.second))) {
          add("edge " + solver::line_label(side.first, side.second),
              "is a side of " + face_label(faces_[f]) + " and missing in edges_vertices",
              "add it with its assignment");
        }
        if (!face_left_of_.try_emplace(side, f).second) {
          add("edge " + solver::line_label(side.first, side.second),
              "has two faces on the same side: the mesh overlaps itself",
              "a sheet lies flat without overlaps");
        }
      }
    }
    for (const auto& [key, assignment] : edges_) {
      const auto& [a, b] = key;
      if (face_left_of_.contains({a, b}) || face_left_of_.contains({b, a})) continue;
      add("edge " + solver::line_label(a, b), "belongs to no face", "take it out");
    }
  }

  // Edges may meet at their common vertex only.
  void check_crossings() {
    struct Box {
      int a, b;
      double left, right, low, high;
    };
    std::vector<Box> boxes;
    for (const auto& [key, assignment] : edges_) {
      const Point &p = points_[key.first], &q = points_[key.second];
      boxes.push_back({key.first, key.second, std::min(p.x(), q.x()), std::max(p.x(), q.x()),
                       std::min(p.y(), q.y()), std::max(p.y(), q.y())});
    }
    std::sort(boxes.begin(), boxes.end(),
              [](const Box& i, const Box& k) { return i.left < k.left; });
    for (std::size_t i = 0; i < boxes.size() && told_ < kMostOfAKind; ++i) {
      for (std::size_t k = i + 1; k < boxes.size() && boxes[k].left <= boxes[i].right; ++k) {
        if (boxes[k].low > boxes[i].high || boxes[i].low > boxes[k].high) continue;
        if (!meet(boxes[i].a, boxes[i].b, boxes[k].a, boxes[k].b)) continue;
        add("edges " + solver::line_label(boxes[i].a, boxes[i].b) + " and " +
                solver::line_label(boxes[k].a, boxes[k].b),
            "cross or touch", "edges may meet at vertices only");
      }
    }
  }

  // Whether two different edges have a point in common that is not a common end.
  bool meet(int a, int b, int c, int d) const {
    const auto side = [&](int from, int to, int of) {
      return cross(points_[to] - points_[from], points_[of] - points_[from]);
    };
    if (b == c || b == d) std::swap(a, b);
    if (a == d) std::swap(c, d);
    if (a == c) {
      return side(a, b, d) == 0 && (points_[b] - points_[a]).dot(points_[d] - points_[a]) > 0;
    }
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
  }

  // Walks round every region of the plane that the edges enclose, each on its left: a face of the
  // file, one that is missing, or the outside.
  void find_gaps() {
    std::vector<std::vector<int>> around(points_.size());  // neighbours, counter-clockwise
    for (const auto& [key, assignment] : edges_) {
      around[key.first].push_back(key.second);
      around[key.second].push_back(key.first);
    }
    for (int v = 0; v < vertex_count(); ++v) {
      const auto angle = [&](int to) {
        const Point along = points_[to] - points_[v];
        return std::atan2(along.y(), along.x());
      };
      std::sort(around[v].begin(), around[v].end(),
                [&](int a, int b) { return angle(a) < angle(b); });
    }
    std::map<std::pair<int, int>, bool> walked;
    int outsides = 0;
    for (const auto& [key, assignment] : edges_) {
      for (const auto& start :
           {std::pair(key.first, key.second), std::pair(key.second, key.first)}) {
        if (face_left_of_.contains(start) || walked[start]) continue;
        std::vector<int> loop;
        double area = 0;
        for (std::pair<int, int> at = start; !walked[at];) {
          walked[at] = true;
          loop.push_back(at.first);
          area += cross(points_[at.first] - points_[start.first],
                        points_[at.second] - points_[start.first]);
          const auto& ring = around[at.second];
          const auto back = std::find(ring.begin(), ring.end(), at.first);
          at = {at.second, back == ring.begin() ? ring.back() : *(back - 1)};
        }
        if (area <= 0) {
          if (++outsides > 1) {
            add("the mesh",
                "is in two pieces: " + label(loop.front()) + " is joined to none of " + label(0) +
                    "'s piece",
                "give one sheet");
          }
        } else {
          fill(loop);
        }
      }
    }
  }

  void fill(const std::vector<int>& loop) {
    bool convex = loop.size() == 4;
    for (std::size_t k = 0; k < loop.size() && convex; ++k) {
      const auto corner = [&](std::size_t i) { return points_[loop[i % 4]]; };
      convex = cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1)) > 0;
    }
    if (!convex) {
      const std::vector<int> shown(
          loop.begin(),
          loop.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(loop.size(), 8)));
      add("the gap " + label(shown) + (shown.size() < loop.size() ? "-..." : ""),
          "is no single missing quadrilateral", "holes may meet at corners, never share an edge");
      return;
    }
    missing_.push_back({loop[0], loop[1], loop[2], loop[3]});
  }

  void check_degrees() {
    sheet_.vertices_mm.resize(2, vertex_count());
    for (int v = 0; v < vertex_count(); ++v) sheet_.vertices_mm.col(v) = points_[v];
    sheet_.facets = faces_;
    sheet_.facets.insert(sheet_.facets.end(), missing_.begin(), missing_.end());
    sheet_.edges = solver::edges_of(sheet_.facets);
    std::vector<int> degree(points_.size(), 0);
    for (const solver::Edge& edge : sheet_.edges) {
      ++degree[edge.a];
      ++degree[edge.b];
    }
    const std::vector<int> interior = solver::interior_vertices(sheet_);
    for (const int v : interior) {
      if (degree[v] == 4) continue;
      add("vertex " + label(v), "has degree " + std::to_string(degree[v]) + ", not 4",
          "only meshes whose inner vertices join four faces are folded");
    }
    if (interior.empty()) add("the mesh", "has no inner vertex", "give more faces");
  }

  // Rows and columns from the first face on, its corners turned so that its first side points most
  // to the right; every face begins at the corner of least row and column.
  void place_faces() {
    std::vector<bool> placed(sheet_.facets.size(), false);
    sheet_.places.resize(sheet_.facets.size());
    Quad& first = sheet_.facets[0];
    const auto points_right = [&](int k) {
      return (points_[first[(k + 1) % 4]] - points_[first[k]]).normalized().x();
    };
    int turn = 0;
    for (int k = 1; k < 4; ++k) {
      if (points_right(k) > points_right(turn)) turn = k;
    }
    std::rotate(first.begin(), first.begin() + turn, first.end());
    placed[0] = true;
    std::vector<int> frontier{0};
    constexpr int kStep[4][2] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};  // row, column across side k
    for (std::size_t next = 0; next < frontier.size(); ++next) {
      const int f = frontier[next];
      for (int k = 0; k < 4; ++k) {
        const int from = sheet_.facets[f][k];
        const solver::Edge& edge =
            sheet_.edges[solver::find_edge(sheet_, from, sheet_.facets[f][(k + 1) % 4])];
        const int g = edge.left == f ? edge.right : edge.left;
        if (g < 0) continue;
        // Over there the side is the opposite one, and ends where it begins here.
        Quad& corners = sheet_.facets[g];
        const auto at = std::find(corners.begin(), corners.end(), from) - corners.begin();
        const auto shift = (at - (k + 3) + 8) % 4;
        const std::array<int, 2> place = {sheet_.places[f][0] + kStep[k][0],
                                          sheet_.places[f][1] + kStep[k][1]};
        if (placed[g]) {
          if (shift == 0 && sheet_.places[g] == place) continue;
          add(face_label(corners), "has no row and column of its own: the mesh winds round itself",
              "give a sheet of rows and columns");
          return;
        }
        std::rotate(corners.begin(), corners.begin() + shift, corners.end());
        sheet_.places[g] = place;
        placed[g] = true;
        frontier.push_back(g);
      }
    }
    const auto unplaced = std::find(placed.begin(), placed.end(), false);
    if (unplaced != placed.end()) {
      add("the mesh",
          "is in two pieces: " + face_label(sheet_.facets[unplaced - placed.begin()]) +
              " shares no edge with the first face's piece",
          "give one sheet");
      return;
    }
    auto places = sheet_.places;
    std::sort(places.begin(), places.end());
    const auto twice = std::adjacent_find(places.begin(), places.end());
    if (twice != places.end()) {
      add("the mesh", "two of its faces have the same row and column: it winds round itself",
          "give a sheet of rows and columns");
      return;
    }
    int least_row = 0, least_column = 0;
    for (const auto& [row, column] : places) {
      least_row = std::min(least_row, row);
      least_column = std::min(least_column, column);
    }
    for (auto& [row, column] : sheet_.places) {
      row -= least_row;
      column -= least_column;
    }
  }

  void finish(FoldMesh& mesh) {
    const int faces = static_cast<int>(faces_.size());
    mesh.assignment.assign(sheet_.edges.size(), 0);
    told_ = 0;
    for (std::size_t e = 0; e < sheet_.edges.size(); ++e) {
      const solver::Edge& edge = sheet_.edges[e];
      if (edge.on_perimeter()) continue;
      const std::string& assignment = edges_.at({edge.a, edge.b});
      const bool at_hole = edge.left >= faces || edge.right >= faces;
      if (assignment == "M" || assignment == "V") {
        mesh.assignment[e] = assignment == "V" ? 1 : -1;
      } else if (!at_hole) {
        add("crease " + solver::line_label(edge.a, edge.b) +
                (assignment.empty() ? "" : " is \"" + assignment.substr(0, 8) + "\""),
            "must be a mountain or a valley", "write \"M\" or \"V\" into edges_assignment");
      }
    }
    for (int f = faces; f < sheet_.facet_count(); ++f) mesh.missing.push_back(f);
    std::vector<double> widths;
    for (const Quad& q : sheet_.facets) widths.push_back((points_[q[1]] - points_[q[0]]).norm());
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::nth_element(widths.begin(), middle, widths.end());
    sheet_.panel_width_mm = *middle;
    mesh.sheet = std::move(sheet_);
  }

  const Json& value_;
  const std::string where_;
  double mm_per_unit_;
  InputFaults& faults_;
  int told_ = 0;
  std::vector<Point> points_;
  std::map<std::pair<int, int>, std::string> edges_;  // ends in order -> assignment
  std::vector<Quad> faces_, missing_;
  std::map<std::pair<int, int>, int> face_left_of_;  // of a side walked from first to second
  solver::CreasePattern sheet_;
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
