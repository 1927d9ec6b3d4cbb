#include "schema/exchange/fold_export.hpp"

#include <algorithm>
#include <cmath>

#include "schema/campaign/carried_pattern.hpp"

namespace misalign::schema {
namespace {

// Where all is folded flat the equations are singular, and angles known to the root of the closure
// tolerance: 6e-5 degrees.
constexpr double kShownOverFold_deg = 1e-3;

using Eigen::Index;

// Creases lie between kept facets; every other edge is one of a hole or of the perimeter.
std::vector<int> crease_of_edge(const solver::CreasePattern& sheet,
                                const solver::Mechanism& mechanism) {
  std::vector<int> creases(sheet.edges.size(), -1);
  for (std::size_t i = 0; i < mechanism.creases.size(); ++i) {
    creases[mechanism.creases[i].edge] = static_cast<int>(i);
  }
  return creases;
}

Json coordinates_json(const Eigen::MatrixXd& points_mm) {
  Json list = Json::array();
  for (Index v = 0; v < points_mm.cols(); ++v) {
    Json point = Json::array();
    for (Index k = 0; k < points_mm.rows(); ++k) point.push_back(points_mm(k, v));
    list.push_back(std::move(point));
  }
  return list;
}

// Angles of one row; flat if there is none. A crease may be closed a little (kOverFoldBand_deg)
// beyond 180 degrees, which readers need not understand.
Json angles_json(const FoldingView& view, const std::vector<int>& crease_of_edge, Index row) {
  Json list = Json::array();
  for (const int crease : crease_of_edge) {
    const double angle = crease >= 0 && row >= 0 ? view.history.fold_angle_deg(row, crease) : 0.0;
    list.push_back(std::clamp(angle, -180.0, 180.0));
  }
  return list;
}

}  // namespace

std::vector<Index> rows_to_show(const FoldingView& view, const solver::ShapedPath& path,
                                double step_deg) {
  std::vector<Index> rows;
  const Index up_to_d = path.rows_up_to_d();
  const Index end =
      up_to_d > 0 ? up_to_d
                  : solver::rows_folded_well(view.mechanism, view.history, kShownOverFold_deg);
  for (Index row = 0; row < end; ++row) {
    const double away = std::remainder(path.history.stations[row].pilot_deg, step_deg);
    if (std::abs(away) < 1e-9 || row + 1 == end) rows.push_back(row);
  }
  return rows;
}

Json folded_fold_json(const FoldingView& view, const solver::ShapedPath& path,
                      const std::vector<Index>& rows, const std::string& title, const Json& data) {
  const solver::CreasePattern& sheet = view.base.base.sheet;
  const std::vector<int> creases = crease_of_edge(sheet, view.mechanism);
  Json frames = Json::array();
  for (const Index row : rows) {
    const double pilot_deg = view.history.stations[row].pilot_deg;
    frames.push_back({{"frame_title", "pilot at " + shown_number(pilot_deg) + " deg"},
                      {"frame_parent", 0},
                      {"frame_inherit", true},
                      {"frame_classes", {"foldedForm"}},
                      {"frame_attributes", {"3D", "orientable"}},
                      {"frame_unit", "mm"},
                      {"vertices_coords", coordinates_json(path.shapes_mm[row])},
                      {"edges_foldAngle", angles_json(view, creases, row)},
                      {"misalign:pilot_deg", pilot_deg}});
  }
  const Eigen::Matrix2Xd vertices_mm = sheet.vertices_mm + view.shifts_mm;
  Json fold = {{"file_spec", 1.2},
               {"file_creator", "misalign"},
               {"file_title", title},
               {"file_classes", {"singleModel", "animation"}},
               {"frame_title", "crease pattern"},
               {"frame_classes", {"creasePattern"}},
               {"frame_attributes", {"2D", "orientable"}},
               {"frame_unit", "mm"},
               {"vertices_coords", coordinates_json(vertices_mm)},
               {"edges_foldAngle", angles_json(view, creases, rows.empty() ? -1 : rows.back())},
               {"file_frames", frames},
               {kCarriedPattern, pattern_json(view.base, view.shifts_mm)},
               {"misalign:data", data}};
  fold.update(perforated_mesh_json(view.base));
  return fold;
}

}  // namespace misalign::schema
