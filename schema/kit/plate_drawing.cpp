#include "schema/kit/plate_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "schema/kit/kit_outline.hpp"
#include "schema/kit/stroke_font.hpp"
#include "schema/pattern/plane_geometry.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kLabelPart = 0.05, kLargestLabel_mm = 4;  // share of the first diagonal

std::string hole_label(const solver::Sheet& sheet, int hole) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  const solver::Diagonal& first = mechanism.diagonals[static_cast<std::size_t>(2 * hole)];
  return panel_label(sheet, mechanism.loops[static_cast<std::size_t>(first.loop)].hole);
}

KitItem plate_item(const solver::Sheet& sheet, const solver::RubberPlates& plates, int hole,
                   const KitOptions& options) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  const std::array<Vector2d, 4> corners_mm = cut_out_mm(sheet, plates, hole);
  const std::array<int, 4> vertices = mechanism.hole_corners(hole);
  const std::string label = hole_label(sheet, hole);
  Ring ring(corners_mm.begin(), corners_mm.end());
  if (signed_area_mm2(ring) < 0) std::ranges::reverse(ring);
  const std::optional<Ring> outline = offset_ring(ring, options.bond_mm + options.kerf_mm / 2);
  if (!outline) {
    throw UserError(solver::OptionFault{"bond_mm", fmt::format("{:g}", options.bond_mm),
                                        "too wide for the plate of hole " + label,
                                        "take narrower bonds"});
  }
  KitItem item = empty_item();
  item.on(KitLayer::cut).paths.push_back({*outline, true});
  LineLayer& engraved = item.on(KitLayer::engrave);
  engraved.paths.push_back({ring, true});
  const double height_mm =
      std::min(kLargestLabel_mm, kLabelPart * (corners_mm[2] - corners_mm[0]).norm());
  const auto engrave = [&](const Vector2d& at_mm, const std::string& words) {
    for (DrawnPath& stroke : strokes_of({at_mm, words, height_mm})) {
      engraved.paths.push_back(std::move(stroke));
    }
  };
  engrave({0, 0}, label);
  for (std::size_t k = 0; k < 4; ++k) {
    engrave(0.7 * corners_mm[k], solver::vertex_label(vertices[k]));
  }
  return item;
}

}  // namespace

std::array<Vector2d, 4> cut_out_mm(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                                   int hole) {
  const std::array<int, 4> vertices = sheet.mechanism().hole_corners(hole);
  const auto flat_mm = [&](std::size_t k) { return sheet.point_mm(vertices[k]); };
  const Vector2d first = flat_mm(2) - flat_mm(0), second = flat_mm(3) - flat_mm(1);
  // Shares of the diagonals up to their crossing.
  const Vector2d apart = flat_mm(1) - flat_mm(0);
  const double along_first = cross(apart, second) / cross(first, second),
               along_second = cross(apart, first) / cross(first, second);
  const solver::HoleShape rest = solver::filling_of(sheet, plates).plate(hole).rest();
  const Vector2d axis = first.normalized() * std::sqrt(rest.first_mm2);
  const Vector2d beside = Vector2d(-axis.y(), axis.x()) * (cross(first, second) > 0 ? 1 : -1);
  const Vector2d other =
      (rest.product_mm2 * axis + std::sqrt(rest.determinant()) * beside) / rest.first_mm2;
  return {-along_first * axis, -along_second * other, (1 - along_first) * axis,
          (1 - along_second) * other};
}

KitSheets kit_plate_sheets(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                           const KitOptions& options, const std::string& title) {
  const KitLayout layout(options);
  std::vector<KitItem> items;
  for (int hole = 0; 2 * hole < sheet.mechanism().diagonal_count(); ++hole) {
    items.push_back(plate_item(sheet, plates, hole, options));
    layout.expect_room("the plate of hole " + hole_label(sheet, hole), items.back());
  }
  return layout.laid_out(items, title);
}

}  // namespace misalign::schema
