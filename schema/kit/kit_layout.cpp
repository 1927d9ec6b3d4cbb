#include "schema/kit/kit_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "schema/files/user_error.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kMarkRadius_mm = 0.5 * kMark_mm;

std::vector<Vector2d> marks_on(const Vector2d& size_mm, double margin_mm) {
  const Vector2d low = Vector2d::Constant(margin_mm + kMarkRadius_mm), high = size_mm - low;
  return {low, {high.x(), low.y()}, {low.x(), high.y()}};
}

// An octagon round a mark.
PlanePoints octagon(const Vector2d& centre_mm) {
  const double radius_mm = kMarkRadius_mm / std::cos(std::numbers::pi / 8);
  PlanePoints corners;
  for (int k = 0; k < 8; ++k) {
    const double rad = std::numbers::pi / 4 * (k + 0.5);
    corners.push_back(centre_mm + radius_mm * Vector2d(std::cos(rad), std::sin(rad)));
  }
  return corners;
}

}  // namespace

std::size_t KitSheets::least_beds() const {
  return static_cast<std::size_t>(std::max(1.0, std::ceil(area_mm2 / room_mm2)));
}

KitLayout::KitLayout(const KitOptions& options) : options_(options) {}

// The bed within its margin.
NestBed KitLayout::bed() const {
  const Vector2d inside = *options_.bed_mm - Vector2d::Constant(2 * options_.margin_mm);
  NestBed bed{inside, options_.gap_mm};
  for (const Vector2d& mark : marks_on(inside, 0)) bed.taken.push_back(octagon(mark));
  return bed;
}

bool KitLayout::has_room(const NestShape& shape) const {
  return !options_.bed_mm || place_alone(shape, bed());
}

void KitLayout::expect_room(const std::string& what, const KitItem& item) const {
  if (has_room(item.shape(options_.turns))) return;
  const Vector2d size = item.size_mm(), room = bed().size_mm;
  throw UserError(solver::OptionFault{
      "bed", fmt::format("{:g}x{:g}", options_.bed_mm->x(), options_.bed_mm->y()),
      fmt::format("{} does not fit, turned or not (its size is {:.1f} x {:.1f} mm, the margin "
                  "leaves {:.1f} x {:.1f}, and three corners have registration marks of {:g} mm)",
                  what, size.x(), size.y(), room.x(), room.y(), kMark_mm),
      "take a larger bed"});
}

KitSheets KitLayout::on_beds(const std::vector<NestShape>& shapes) const {
  const NestBed bed = this->bed();
  NestResult nested = nest(shapes, bed);
  KitSheets sheets;
  sheets.beds.resize(nested.beds);
  sheets.places = std::move(nested.places);
  sheets.size_mm = *options_.bed_mm;
  sheets.room_mm2 = bed.size_mm.prod();
  sheets.used_mm = nested.used_mm.back().y();
  for (Nested& place : sheets.places) place.moved_mm += Vector2d::Constant(options_.margin_mm);
  return sheets;
}

// The least sheet of several widths, with a strip for marks above and below the items.
KitSheets KitLayout::on_one_sheet(const std::vector<NestShape>& shapes) const {
  double area_mm2 = 0, widest_mm = 0;
  for (const NestShape& shape : shapes) {
    area_mm2 += shape.area_mm2;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const PlanePoints& piece : shape.pieces) {
      for (const Vector2d& point : piece) {
        least = std::min(least, point.x());
        most = std::max(most, point.x());
      }
    }
    widest_mm = std::max(widest_mm, most - least);
  }
  const double strip_mm = kMark_mm + options_.gap_mm;
  KitSheets sheets;
  sheets.beds.resize(1);
  double least_mm2 = std::numeric_limits<double>::infinity();
  for (const double loose : {1.1, 1.4, 1.8}) {
    const double width_mm = std::max(widest_mm, loose * std::sqrt(area_mm2));
    NestResult nested =
        nest(shapes, {{width_mm, std::numeric_limits<double>::infinity()}, options_.gap_mm});
    const Vector2d used = nested.used_mm[0];
    if (used.prod() >= least_mm2) continue;
    least_mm2 = used.prod();
    sheets.places = std::move(nested.places);
    sheets.used_mm = used.y() + 2 * strip_mm;
    sheets.size_mm = Vector2d(std::max(used.x(), 2 * kMark_mm), sheets.used_mm) +
                     Vector2d::Constant(2 * options_.margin_mm);
  }
  sheets.room_mm2 = (sheets.size_mm - Vector2d::Constant(2 * options_.margin_mm)).prod();
  for (Nested& place : sheets.places) {
    place.moved_mm += Vector2d(options_.margin_mm, options_.margin_mm + strip_mm);
  }
  return sheets;
}

KitSheets KitLayout::laid_out(const std::vector<KitItem>& items, const std::string& title) const {
  std::vector<NestShape> shapes;
  for (const KitItem& item : items) shapes.push_back(item.shape(options_.turns));
  KitSheets sheets = options_.bed_mm ? on_beds(shapes) : on_one_sheet(shapes);
  sheets.area_mm2 = 0;
  for (const NestShape& shape : shapes) sheets.area_mm2 += shape.area_mm2;
  sheets.marks_mm = marks_on(sheets.size_mm, options_.margin_mm);
  std::vector<KitItem> pages(sheets.beds.size(), empty_item(sheets.size_mm));
  for (std::size_t k = 0; k < items.size(); ++k) {
    pages[sheets.places[k].bed].add(items[k], sheets.places[k]);
  }
  for (std::size_t b = 0; b < pages.size(); ++b) {
    for (const Vector2d& mark : sheets.marks_mm) {
      pages[b]
          .on(KitLayer::registration)
          .circles.push_back({mark, kMarkRadius_mm - 0.5 * options_.kerf_mm});
    }
    pages[b].drawing.title = title;
    pages[b].drawing.unit = options_.unit;
    sheets.beds[b] = without_empty_layers(std::move(pages[b].drawing));
  }
  return sheets;
}

}  // namespace misalign::schema
