#include "schema/kit/plate_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "schema/kit/kit_layout.hpp"
#include "schema/kit/kit_notes.hpp"
#include "schema/kit/kit_outline.hpp"
#include "schema/kit/stroke_font.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "solver/sheet/sheet_filling.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kLabelPart = 0.05, kLargestLabel_mm = 4;  // share of the first diagonal

std::array<int, 4> corners_of(const solver::Mechanism& mechanism, int hole) {
  const auto d = static_cast<std::size_t>(2 * hole);
  assert(d + 1 < mechanism.diagonals.size());
  return {mechanism.diagonals[d].from, mechanism.diagonals[d + 1].from, mechanism.diagonals[d].to,
          mechanism.diagonals[d + 1].to};
}

KitItem plate_item(const solver::Sheet& sheet, const solver::RubberPlates& plates, int hole,
                   const KitOptions& options) {
  const solver::Mechanism& mechanism = sheet.mechanism();
  const std::array<Vector2d, 4> corners_mm = cut_out_mm(sheet, plates, hole);
  const std::array<int, 4> vertices = corners_of(mechanism, hole);
  const solver::Diagonal& first = mechanism.diagonals[static_cast<std::size_t>(2 * hole)];
  const std::string label =
      panel_label(sheet, mechanism.loops[static_cast<std::size_t>(first.loop)].hole);
  Ring ring(corners_mm.begin(), corners_mm.end());
  if (signed_area_mm2(ring) < 0) std::ranges::reverse(ring);
  const std::optional<Ring> outline = offset_ring(ring, options.bond_mm + options.kerf_mm / 2);
  if (!outline) {
    throw UserError(solver::OptionFault{"bond_mm", fmt::format("{:g}", options.bond_mm),
                                        "too wide for the plate of hole " + label,
                                        "take narrower bonds"});
  }
  Vector2d least = outline->front(), most = least;
  for (const Vector2d& point : *outline) {
    least = least.cwiseMin(point);
    most = most.cwiseMax(point);
  }
  KitItem item = empty_item(least, most);
  item.may_turn = true;
  item.on(KitLayer::cut).paths.push_back({*outline, true});
  LineLayer& engraved = item.on(KitLayer::engrave);
  engraved.paths.push_back({ring, true});
  const double height_mm =
      std::min(kLargestLabel_mm, kLabelPart * (corners_mm[2] - corners_mm[0]).norm());
  const auto engrave = [&](const Vector2d& at_mm, const std::string& words) {
    for (DrawnPath& stroke : strokes_of({at_mm, words, height_mm, true})) {
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
  const std::array<int, 4> vertices = corners_of(sheet.mechanism(), hole);
  const auto flat_mm = [&](std::size_t k) { return sheet.point_mm(vertices[k]); };
  const Vector2d first = flat_mm(2) - flat_mm(0), second = flat_mm(3) - flat_mm(1);
  const auto cross = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
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

LineDrawing kit_plate_drawing(const solver::Sheet& sheet, const solver::RubberPlates& plates,
                              const KitOptions& options, const std::string& title) {
  std::vector<KitItem> items;
  std::vector<LayoutBox> boxes;
  for (int hole = 0; 2 * hole < sheet.mechanism().diagonal_count(); ++hole) {
    items.push_back(plate_item(sheet, plates, hole, options));
    boxes.push_back({items.back().size_mm(), true});
  }
  const double width_mm = std::max(sheet_width_mm(boxes, options.gap_mm), kLeastHeading_mm);
  const std::vector<LaidOut> laid = lay_out(boxes, {width_mm, INFINITY}, options.gap_mm);
  double used_mm = 0;
  for (std::size_t k = 0; k < laid.size(); ++k) {
    const Vector2d& size = boxes[k].size_mm;
    used_mm = std::max(used_mm, laid[k].at_mm.y() + (laid[k].turned ? size.x() : size.y()));
  }
  const KitItem heading = kit_heading(
      {title,
       fmt::format(
           "rubber plates of {:g} mm, shear modulus {:g} MPa, free of stress (mm); kerf {:g}",
           plates.thickness_mm, plates.shear_mpa, options.kerf_mm),
       fmt::format("bonds of {:g} mm; stretch each plate until its line lies on the hole's edges",
                   options.bond_mm)},
      width_mm);
  const Vector2d margin = Vector2d::Constant(options.margin_mm);
  KitItem page = empty_item(
      {0, 0}, 2 * margin + Vector2d(width_mm, used_mm + options.gap_mm + heading.size_mm().y()));
  page.drawing.title = title;
  page.add(heading, margin, false);
  for (std::size_t k = 0; k < items.size(); ++k) {
    const double height_mm = laid[k].turned ? boxes[k].size_mm.x() : boxes[k].size_mm.y();
    page.add(items[k],
             {margin.x() + laid[k].at_mm.x(),
              page.drawing.most_mm.y() - margin.y() - laid[k].at_mm.y() - height_mm},
             laid[k].turned);
  }
  std::erase_if(page.drawing.layers, [](const LineLayer& layer) { return layer.is_empty(); });
  return std::move(page.drawing);
}

}  // namespace misalign::schema
