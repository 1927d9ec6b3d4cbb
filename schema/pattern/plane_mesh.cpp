#include "schema/pattern/plane_mesh.hpp"

#include <algorithm>

#include "schema/pattern/sheet_places.hpp"

namespace misalign::schema {
namespace {

constexpr double kLeastSize_mm = 1e-3;  // far above an underflow of products of coordinates
// Vertices closer than this part of the sheet's size are the same point.
constexpr double kSamePoint = 1e-7;

using Quad = std::array<int, 4>;
using Point = Eigen::Vector2d;

// Checks in stages; a stage that finds faults is the last.
class MeshReader {
 public:
  MeshReader(const PlaneMesh& mesh, MeshFaults& faults)
      : points_(mesh.points_mm),
        edges_(mesh.edges),
        has_faces_(mesh.has_faces),
        faults_(faults),
        faces_(mesh.faces) {}

  const std::vector<Quad>& faces() const { return faces_; }

  std::optional<solver::CreasePattern> build() {
    for (const Stage stage : stages()) {
      faults_.next_kind();
      (this->*stage)();
      if (faults_.any()) return std::nullopt;
    }
    sheet_.panel_width_mm = median_width_mm(sheet_);
    return std::move(sheet_);
  }

 private:
  using Stage = void (MeshReader::*)();

  // Stages of the check. Crossings are searched before faces. In a file with faces, which may have
  // any number of edges, crossings wait until all edges are sides of faces.
  std::vector<Stage> stages() const {
    std::vector<Stage> all{&MeshReader::check_points};
    const auto append = [&](std::initializer_list<Stage> more) { all.insert(all.end(), more); };
    if (!has_faces_) append({&MeshReader::check_crossings, &MeshReader::find_faces});
    append({&MeshReader::check_vertices, &MeshReader::orient_faces, &MeshReader::pair_edges});
    if (has_faces_) append({&MeshReader::check_crossings});
    append({&MeshReader::find_gaps, &MeshReader::check_degrees, &MeshReader::place});
    return all;
  }

  void add(const std::string& problem, const std::string& why, const std::string& suggestion) {
    faults_.add(problem, why, suggestion);
  }

  static std::string label(int v) { return solver::vertex_label(v); }
  static std::string label(const std::vector<int>& loop) {
    std::string text;
    for (const int v : loop) text += (text.empty() ? "" : "-") + label(v);
    return text;
  }
  static std::string shortened(std::vector<int> loop) {
    constexpr std::size_t kMost = 8;
    if (loop.size() <= kMost) return label(loop);
    loop.resize(kMost);
    return label(loop) + "-...";
  }
  int vertex_count() const { return static_cast<int>(points_.size()); }

  void check_points() {
    double size = 0;
    for (const Point& p : points_) size = std::max(size, (p - points_[0]).cwiseAbs().maxCoeff());
    if (!(size >= kLeastSize_mm)) {
      add("the mesh", "is smaller than " + shown_number(kLeastSize_mm) + " mm",
          "say how long a unit is in frame_unit or mm_per_unit");
      return;
    }
    for (const auto& [a, b] : coinciding(points_, kSamePoint * size, MeshFaults::kMostOfAKind)) {
      add("vertices " + label(a) + " and " + label(b), "are the same point",
          "join them into one vertex");
    }
  }

  // Finds the faces of a file without faces.
  void find_faces() {
    FacesOfRegions found = faces_of_edges(points_, edges_);
    for (const auto& [a, b] : found.contradictions) {
      add("edge " + solver::line_label(a, b) + " is \"" + edges_.at({a, b}).substr(0, 8) + "\"",
          "faces_vertices is missing, and the other edges do not agree with it on what is a face: "
          "\"B\" and \"C\" border one face, any other edge joins two",
          "correct the assignment, or give faces_vertices");
    }
    for (const std::vector<int>& loop : found.not_four_sided) {
      add("the face " + shortened(loop),
          "has " + std::to_string(loop.size()) + " sides: the mesh must be one of quadrilaterals",
          "correct the edges, or give faces_vertices");
    }
    if (found.faces.size() > kMostFaces) {
      add("the mesh",
          "has " + std::to_string(found.faces.size()) + " faces, more than " +
              std::to_string(kMostFaces),
          "take a part of the mesh");
    }
    faces_ = std::move(found.faces);
  }

  void check_vertices() {
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
      if (is_convex(points_, q)) continue;
      add(face_label(q), "is no convex quadrilateral",
          "give its corners in order, no three on a line");
    }
  }

  // Checks that every side of a face is an edge of the file, with at most one face on each of its
  // sides.
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

  // Checks that edges meet only at common vertices.
  void check_crossings() {
    for (const auto& [edge, other] : crossing(points_, edges_, MeshFaults::kMostOfAKind)) {
      add("edges " + solver::line_label(edge.first, edge.second) + " and " +
              solver::line_label(other.first, other.second),
          "cross or touch", "edges may meet at vertices only");
    }
  }

  // Walks round every region of the plane that edges enclose, on its left: a face of the file, a
  // missing one, or the outside.
  void find_gaps() {
    int outsides = 0;
    for (const PlaneRegion& region : regions_of(
             points_, edges_, [&](const auto& side) { return !face_left_of_.contains(side); })) {
      if (region.bounded()) {
        fill(region.loop);
      } else if (++outsides > 1) {
        add("the mesh",
            "is in two pieces: " + label(region.loop.front()) + " is joined to none of " +
                label(0) + "'s piece",
            "give one sheet");
      }
    }
  }

  void fill(const std::vector<int>& loop) {
    if (loop.size() != 4 || !is_convex(points_, loop)) {
      add("the gap " + shortened(loop), "is no single missing quadrilateral",
          "holes may meet at corners, never share an edge");
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

  void place() {
    if (const auto none = place_faces(sheet_)) add(none->problem, none->why, none->suggestion);
  }

  const PlanePoints& points_;
  const PlaneEdges& edges_;
  const bool has_faces_;
  MeshFaults& faults_;
  std::vector<Quad> faces_, missing_;
  std::map<std::pair<int, int>, int> face_left_of_;  // left of a side from first to second
  solver::CreasePattern sheet_;
};

}  // namespace

void MeshFaults::add(const std::string& problem, const std::string& why,
                     const std::string& suggestion) {
  if (++told_ > kMostOfAKind) return;
  faults_.add(where_.empty() ? problem : where_ + ": " + problem, why, suggestion);
}

std::optional<solver::CreasePattern> fill_sheet(PlaneMesh& mesh, MeshFaults& faults) {
  MeshReader builder(mesh, faults);
  auto sheet = builder.build();
  if (!mesh.has_faces) mesh.faces = builder.faces();
  return sheet;
}

}  // namespace misalign::schema
