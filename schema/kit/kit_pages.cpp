#include "schema/kit/kit_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "schema/files/user_error.hpp"
#include "schema/kit/kit_notes.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

}  // namespace

KitPages::KitPages(const KitOptions& options, std::string title, Heading heading)
    : options_(options), title_(std::move(title)), heading_(std::move(heading)) {
  if (!options_.bed_mm) return;
  const Vector2d inside = *options_.bed_mm - Vector2d::Constant(2 * options_.margin_mm);
  if (inside.x() >= kLeastHeading_mm && room_mm().y() > 0) return;
  refuse_bed(fmt::format(
      "too small for the title and a gauge of 100 mm (they take {:g} x {:g} mm, and {} round it)",
      kLeastHeading_mm, inside.y() - room_mm().y(),
      parameter("margin_mm", fmt::format("{:g}", options_.margin_mm))));
}

Vector2d KitPages::room_mm() const {
  if (!options_.bed_mm) return Vector2d::Constant(INFINITY);
  const Vector2d inside = *options_.bed_mm - Vector2d::Constant(2 * options_.margin_mm);
  constexpr std::size_t kMany = 999;
  const double heading_mm =
      kit_heading(heading_(kMany, kMany), std::max(inside.x(), kLeastHeading_mm)).size_mm().y();
  return {inside.x(), inside.y() - heading_mm - options_.gap_mm};
}

void KitPages::refuse_bed(const std::string& why) const {
  throw UserError(solver::OptionFault{
      "bed", fmt::format("{:g}x{:g}", options_.bed_mm->x(), options_.bed_mm->y()), why,
      "take a larger bed"});
}

void KitPages::expect_room(const std::string& what, const LayoutBox& box) const {
  const Vector2d room = room_mm();
  if (fits_bed(box, room)) return;
  refuse_bed(
      fmt::format("{} does not fit{} (its size is {:.1f} x {:.1f} mm, and margin and heading leave "
                  "{:.1f} x {:.1f})",
                  what, box.may_turn ? ", turned or not" : "", box.size_mm.x(), box.size_mm.y(),
                  room.x(), room.y()));
}

std::vector<LineDrawing> KitPages::laid_out(const std::vector<KitItem>& items) const {
  const double gap_mm = options_.gap_mm;
  const Vector2d margin = Vector2d::Constant(options_.margin_mm);
  Vector2d room = room_mm();
  std::vector<LayoutBox> boxes;
  for (const KitItem& item : items) boxes.push_back({item.size_mm(), item.may_turn});
  if (!options_.bed_mm) room.x() = std::max(sheet_width_mm(boxes, gap_mm), kLeastHeading_mm);
  const std::vector<LaidOut> laid = lay_out(boxes, room, gap_mm);
  std::size_t pages = 1;
  Vector2d used(0, 0);
  for (std::size_t k = 0; k < laid.size(); ++k) {
    const Vector2d& size = boxes[k].size_mm;
    pages = std::max(pages, static_cast<std::size_t>(laid[k].bed) + 1);
    used = used.cwiseMax(laid[k].at_mm + (laid[k].turned ? size.reverse().eval() : size));
  }
  if (!options_.bed_mm) room.x() = std::max(used.x(), kLeastHeading_mm);
  std::vector<KitItem> sheets;
  for (std::size_t page = 0; page < pages; ++page) {
    const KitItem heading = kit_heading(heading_(page, pages), room.x());
    const Vector2d size_mm =
        options_.bed_mm
            ? *options_.bed_mm
            : Vector2d(2 * margin + Vector2d(room.x(), used.y() + gap_mm + heading.size_mm().y()));
    sheets.push_back(empty_item({0, 0}, size_mm));
    sheets.back().drawing.title = title_;
    sheets.back().add(heading, margin, false);
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    KitItem& sheet = sheets[static_cast<std::size_t>(laid[k].bed)];
    const double height = laid[k].turned ? boxes[k].size_mm.x() : boxes[k].size_mm.y();
    sheet.add(items[k],
              {margin.x() + laid[k].at_mm.x(),
               sheet.drawing.most_mm.y() - margin.y() - laid[k].at_mm.y() - height},
              laid[k].turned);
  }
  std::vector<LineDrawing> drawings;
  for (KitItem& sheet : sheets) {
    std::erase_if(sheet.drawing.layers, [](const LineLayer& layer) { return layer.is_empty(); });
    drawings.push_back(std::move(sheet.drawing));
  }
  return drawings;
}

}  // namespace misalign::schema
