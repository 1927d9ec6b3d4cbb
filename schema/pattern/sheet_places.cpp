#include "schema/pattern/sheet_places.hpp"

#include <algorithm>
#include <utility>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {
namespace {

using Corners = std::array<int, 4>;

Eigen::Vector2d side_of(const solver::CreasePattern& sheet, const Corners& face, int k) {
  return Eigen::Vector2d(sheet.vertices_mm.col(face[(k + 1) % 4])) -
         Eigen::Vector2d(sheet.vertices_mm.col(face[k]));
}

void turn_to_the_right(const solver::CreasePattern& sheet, Corners& face) {
  const auto points_right = [&](int k) { return side_of(sheet, face, k).normalized().x(); };
  int turn = 0;
  for (int k = 1; k < 4; ++k) {
    if (points_right(k) > points_right(turn)) turn = k;
  }
  std::rotate(face.begin(), face.begin() + turn, face.end());
}

// Places faces from the first across all sides; `placed` tells which were reached.
std::optional<NoPlaces> place_from_the_first(solver::CreasePattern& sheet,
                                             std::vector<bool>& placed) {
  placed[0] = true;
  std::vector<int> frontier{0};
  constexpr int kStep[4][2] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};  // row, column across side k
  for (std::size_t next = 0; next < frontier.size(); ++next) {
    const int f = frontier[next];
    for (int k = 0; k < 4; ++k) {
      const int from = sheet.facets[f][k];
      const solver::Edge& edge =
          sheet.edges[solver::find_edge(sheet, from, sheet.facets[f][(k + 1) % 4])];
      const int g = edge.left == f ? edge.right : edge.left;
      if (g < 0) continue;
      // The side is the opposite one on face g, and ends where it begins on this face.
      Corners& corners = sheet.facets[g];
      const auto at = std::find(corners.begin(), corners.end(), from) - corners.begin();
      const auto shift = (at - (k + 3) + 8) % 4;
      const std::array<int, 2> place = {sheet.places[f][0] + kStep[k][0],
                                        sheet.places[f][1] + kStep[k][1]};
      if (placed[g]) {
        if (shift == 0 && sheet.places[g] == place) continue;
        return NoPlaces{face_label(corners),
                        "has no row and column of its own: the mesh winds round itself",
                        "give a sheet of rows and columns"};
      }
      std::rotate(corners.begin(), corners.begin() + shift, corners.end());
      sheet.places[g] = place;
      placed[g] = true;
      frontier.push_back(g);
    }
  }
  return std::nullopt;
}

void count_from_zero(std::vector<std::array<int, 2>>& places) {
  int least_row = 0, least_column = 0;
  for (const auto& [row, column] : places) {
    least_row = std::min(least_row, row);
    least_column = std::min(least_column, column);
  }
  for (auto& [row, column] : places) {
    row -= least_row;
    column -= least_column;
  }
}

}  // namespace

std::string face_label(const Corners& corners) {
  std::string label = "the face ";
  for (int k = 0; k < 4; ++k) label += (k > 0 ? "-" : "") + solver::vertex_label(corners[k]);
  return label;
}

std::optional<NoPlaces> place_faces(solver::CreasePattern& sheet) {
  sheet.places.resize(sheet.facets.size());
  turn_to_the_right(sheet, sheet.facets[0]);
  std::vector<bool> placed(sheet.facets.size(), false);
  if (auto none = place_from_the_first(sheet, placed)) return none;
  const auto unplaced = std::find(placed.begin(), placed.end(), false);
  if (unplaced != placed.end()) {
    return NoPlaces{"the mesh",
                    "is in two pieces: " + face_label(sheet.facets[unplaced - placed.begin()]) +
                        " shares no edge with the first face's piece",
                    "give one sheet"};
  }
  auto places = sheet.places;
  std::sort(places.begin(), places.end());
  if (std::adjacent_find(places.begin(), places.end()) != places.end()) {
    return NoPlaces{"the mesh",
                    "two of its faces have the same row and column: it winds round itself",
                    "give a sheet of rows and columns"};
  }
  count_from_zero(sheet.places);
  return std::nullopt;
}

double median_width_mm(const solver::CreasePattern& sheet) {
  std::vector<double> widths_mm;
  for (const Corners& face : sheet.facets) widths_mm.push_back(side_of(sheet, face, 0).norm());
  return median(std::move(widths_mm));
}

}  // namespace misalign::schema
