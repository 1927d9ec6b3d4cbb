#include "schema/kit/hinge_marks.hpp"

#include <fmt/format.h>

#include "schema/kit/plate_ring.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr PlateFace face_of(const PlateEdge& edge) {
  return edge.valley ? PlateFace::upper : PlateFace::lower;
}

}  // namespace

void add_hinges(const solver::Sheet& sheet, int facet, const KitFittings& fittings, KitItem& item) {
  const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  for (std::size_t k = 0; k < 4; ++k) {
    const PlateEdge& edge = fittings.edges.edge(facet, k);
    if (edge.crease < 0) continue;
    item.on(KitLayer::hinge)
        .paths.push_back({{sheet.point_mm(around[k]), sheet.point_mm(around[(k + 1) % 4])}, false});
    if (edge.bevel_mm == 0) continue;
    const auto [from, to] = plate_face(sheet, facet, fittings, face_of(edge)).side(k);
    item.on(edge.valley ? KitLayer::score_valley : KitLayer::score_mountain)
        .paths.push_back({{from, to}, false});
  }
}

std::vector<DrawnText> bevel_angles(const solver::Sheet& sheet, int facet,
                                    const KitFittings& fittings, double height_mm,
                                    PanelRoom& room) {
  constexpr double kAway = 2;  // distance of the words from the line, in their heights
  std::vector<DrawnText> texts;
  for (std::size_t k = 0; k < 4; ++k) {
    const PlateEdge& edge = fittings.edges.edge(facet, k);
    if (edge.bevel_mm == 0) continue;
    const auto [from, to] = plate_face(sheet, facet, fittings, face_of(edge)).side(k);
    const Vector2d along = (to - from).normalized(), inwards(-along.y(), along.x());
    std::vector<Vector2d> middles_mm;
    for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) {
      middles_mm.emplace_back(from + share * (to - from) + kAway * height_mm * inwards);
    }
    const auto text = room.place(fmt::format("b{:g}", edge.bevel_deg), height_mm, middles_mm);
    if (text) texts.push_back(*text);
  }
  return texts;
}

}  // namespace misalign::schema
