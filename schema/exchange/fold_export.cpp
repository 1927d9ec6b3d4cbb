#include "schema/exchange/fold_export.hpp"

#include <algorithm>
#include <cassert>

#include "schema/files/json_values.hpp"
#include "schema/pattern/carried_pattern.hpp"
#include "schema/pattern/filled_mesh.hpp"
#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {
namespace {

using Eigen::Index;

// Creases lie between kept facets; every other edge is one of a hole or of the perimeter.
std::vector<int> crease_of_edge(const solver::CreasePattern& sheet,
                                const solver::Mechanism& mechanism) {
  std::vector<int> creases(sheet.edges.size(), -1);
  assert(sheet.edges.size() == mechanism.edges.size());
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    creases[mechanism.creases[i].edge] = static_cast<int>(i);
  }
  return creases;
}

Json coordinates_json(const Eigen::MatrixXd& points_mm) {
  return json_list(points_mm.colwise(),
                   [](const auto& point) { return json_list(point, std::identity()); });
}

// Fold angles of one row; 0 without a row. Angles slightly (kOverFoldBand_deg) beyond 180 degrees,
// which readers may refuse, are clipped.
Json angles_json(const FoldingView& view, const std::vector<int>& crease_of_edge, Index row) {
  return json_list(crease_of_edge, [&](int crease) {
    const double angle = crease >= 0 && row >= 0 ? view.history.fold_angle_deg(row, crease) : 0.0;
    return std::clamp(angle, -180.0, 180.0);
  });
}

constexpr const char* kPlainDescription =
    "The folded shapes are in file_frames. Two panels that share only a vertex have a ball joint, "
    "which this format cannot express: programs that fold along a tree of creases cannot place "
    "panels that only ball joints hold. `misalign export --format fold --joined` writes hinges "
    "for them.";
constexpr const char* kJoinedDescription =
    "The folded shapes are in file_frames. The last faces, those of misalign:fillers, are no "
    "panels: two triangles in the corner of a hole replace each ball joint by three hinges, so "
    "that "
    "all panels can be placed along a tree of creases. They are not part of the sheet.";

// Places the fillers of a sheet, flat and in each of its frames.
class Fillers {
 public:
  Fillers(const FoldingView& view, const std::vector<solver::Filler>& fillers)
      : view_(view), fillers_(fillers) {}

  // Fillers with the letters (M, V) of their hinges in a row.
  std::vector<MeshFiller> lettered(Index row) const {
    std::vector<MeshFiller> lettered;
    for (const solver::Filler& filler : fillers_) {
      std::string hinges;
      for (const double angle : folded(filler, row).angle_deg) hinges += angle > 0 ? 'V' : 'M';
      lettered.push_back({filler, hinges});
    }
    return lettered;
  }
  void add_flat(Json& points) const {
    for (const solver::Filler& filler : fillers_) {
      const Eigen::Vector2d apex_mm = solver::flat_apex_mm(filler, flat_mm_);
      points.push_back({apex_mm.x(), apex_mm.y()});
    }
  }
  void add_folded(Index row, Json& points, Json& angles) const {
    for (std::size_t i = 0; i < fillers_.size(); ++i) {
      const solver::Filler::Folded shape = folded(fillers_[i], row);
      points.push_back({shape.apex_mm.x(), shape.apex_mm.y(), shape.apex_mm.z()});
      for (int k = 0; k < 3; ++k) angles.push_back(0.0);
      const auto edges = hinge_edges(view_.base.base.sheet, fillers_[i], i);
      for (std::size_t k = 0; k < edges.size(); ++k) angles[edges[k]] = shape.angle_deg[k];
    }
  }

 private:
  solver::Filler::Folded folded(const solver::Filler& filler, Index row) const {
    assert(row >= 0 && row < std::ssize(view_.sheet.shapes_mm()));
    return solver::folded_filler(filler, view_.base.base, flat_mm_,
                                 view_.sheet.shapes_mm()[static_cast<std::size_t>(row)]);
  }

  const FoldingView& view_;
  const std::vector<solver::Filler>& fillers_;
  const Eigen::Matrix2Xd& flat_mm_ = view_.sheet.vertices_mm();
};

Json frame_json(double pilot_deg) {
  return {{"frame_title", "pilot at " + shown_number(pilot_deg) + " deg"},
          {"frame_parent", 0},
          {"frame_inherit", true},
          {"frame_classes", {"foldedForm"}},
          {"frame_attributes", {"3D", "orientable"}},
          {"frame_unit", "mm"},
          {"misalign:pilot_deg", pilot_deg}};
}

}  // namespace

Json folded_fold_json(const FoldingView& view, const std::vector<Index>& rows,
                      const std::string& title, const Json& data,
                      const std::vector<solver::Filler>& chosen) {
  const solver::CreasePattern& sheet = view.base.base.sheet;
  const std::vector<int> creases = crease_of_edge(sheet, view.mechanism);
  const std::vector<solver::Filler> none;  // sheets without rows have none
  const Fillers fillers(view, rows.empty() ? none : chosen);
  Json mesh = perforated_mesh_json(view.base), frames = Json::array();
  const std::vector<MeshFiller> lettered =
      rows.empty() ? std::vector<MeshFiller>{} : fillers.lettered(rows.back());
  for (const Index row : rows) {
    assert(row >= 0 && row < std::ssize(view.history.stations));
    Json frame = frame_json(view.history.stations[row].pilot_deg);
    Json points = coordinates_json(view.sheet.shapes_mm()[static_cast<std::size_t>(row)]),
         angles = angles_json(view, creases, row);
    fillers.add_folded(row, points, angles);
    frame["vertices_coords"] = std::move(points);
    frame["edges_foldAngle"] = std::move(angles);
    frames.push_back(std::move(frame));
  }
  Json points = coordinates_json(view.sheet.vertices_mm());
  fillers.add_flat(points);
  Json fold = {{"file_spec", 1.2},
               {"file_creator", "misalign"},
               {"file_title", title},
               {"file_description", chosen.empty() ? kPlainDescription : kJoinedDescription},
               {"file_classes", {"singleModel", "animation"}},
               {"frame_title", "crease pattern"},
               {"frame_classes", {"creasePattern"}},
               {"frame_attributes", {"2D", "orientable"}},
               {"frame_unit", "mm"},
               {"vertices_coords", points},
               {"edges_foldAngle",
                frames.empty() ? angles_json(view, creases, -1) : frames.back()["edges_foldAngle"]},
               {"file_frames", frames},
               {kCarriedPattern, pattern_json(view.base, view.shifts_mm)},
               {"misalign:data", data}};
  if (!lettered.empty()) fold[kFillers] = add_fillers(view.base, lettered, mesh);
  fold.update(mesh);
  return fold;
}

}  // namespace misalign::schema
