#include "schema/kit/strip_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_outline.hpp"
#include "schema/kit/stroke_font.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

// Heights of names: the largest, and as a share of the material beside a bore.
constexpr double kLargestName_mm = 2.5, kNamePart = 0.8;

// A strip along x with the vertex at the origin; bores at these distances from it.
KitItem strip_item(int vertex, double before_mm, double behind_mm, const KitOptions& options) {
  const solver::JointParts& parts = *options.joints;
  const double bore_mm = 0.5 * parts.bore_mm, edge_mm = bore_mm + options.bore_edge_mm,
               free_mm = 0.5 * parts.strip_mm;
  if (free_mm > std::min(before_mm, behind_mm) - bore_mm) {
    throw UserError(solver::OptionFault{
        "joints.strip_mm", fmt::format("{:g}", parts.strip_mm),
        fmt::format("too long for the tab at {} (bores leave {:.3g} mm between them)",
                    solver::vertex_label(vertex), 2 * (std::min(before_mm, behind_mm) - bore_mm)),
        "take a shorter one, or a larger " + parameter("bore_edge_mm")});
  }
  KitItem item = empty_item();
  const double left = -before_mm - edge_mm, right = behind_mm + edge_mm;
  const Ring ring = {{left, -edge_mm}, {right, -edge_mm}, {right, edge_mm}, {left, edge_mm}};
  item.on(KitLayer::cut).paths.push_back({offset_ring(ring, 0.5 * options.kerf_mm).value(), true});
  for (const double x : {-before_mm, behind_mm}) {
    item.on(KitLayer::bore).circles.push_back({{x, 0}, bore_mm - 0.5 * options.kerf_mm});
  }
  LineLayer& engraved = item.on(KitLayer::engrave);
  for (const double x : {-free_mm, free_mm}) {
    engraved.paths.push_back({{{x, -edge_mm}, {x, edge_mm}}, false});
  }
  const double height_mm = std::min(kLargestName_mm, kNamePart * options.bore_edge_mm);
  const Vector2d base(behind_mm, 0.5 * (bore_mm + edge_mm - height_mm));  // above the second bore
  for (DrawnPath& stroke : strokes_of({base, solver::vertex_label(vertex), height_mm})) {
    engraved.paths.push_back(std::move(stroke));
  }
  return item;
}

}  // namespace

KitSheets kit_strip_sheets(const solver::Sheet& sheet, const KitFittings& fittings,
                           const KitOptions& options, const std::string& title) {
  const auto& balls = sheet.mechanism().balls;
  if (!options.joints || options.joints->kind != solver::JointKind::tab || balls.empty()) return {};
  if (options.bore_edge_mm == 0) {
    throw UserError(solver::OptionFault{"bore_edge_mm", "0", "leaves nothing of tabs beside bores",
                                        "take more"});
  }
  const KitLayout layout(options);
  std::vector<KitItem> items;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const Vector2d vertex_mm = sheet.point_mm(balls[k].vertex);
    const Vector2d first = fittings.bores[2 * k].centre_mm - vertex_mm,
                   second = fittings.bores[2 * k + 1].centre_mm - vertex_mm;
    assert(fittings.bores[2 * k].vertex == balls[k].vertex);
    const Vector2d along = (second - first).normalized();
    items.push_back(strip_item(balls[k].vertex, -first.dot(along), second.dot(along), options));
    layout.expect_room("the tab at " + solver::vertex_label(balls[k].vertex), items.back());
  }
  return layout.laid_out(items, title);
}

}  // namespace misalign::schema
