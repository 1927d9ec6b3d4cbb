#include "schema/kit/kit_layout.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kRounding_mm = 1e-9;

bool fits(const Vector2d& size, const Vector2d& room) {
  return (size - room).maxCoeff() <= kRounding_mm;
}

Vector2d turned(const Vector2d& size) { return {size.y(), size.x()}; }

struct Column {
  double x, width, used;
};

struct Shelf {
  double y, height, used = 0;
  std::vector<Column> columns;

  std::optional<Vector2d> take(const Vector2d& size, double bed_width, double gap) {
    for (Column& column : columns) {
      if (!fits(size, {column.width, height - column.used - gap})) continue;
      const Vector2d at(column.x, y + column.used + gap);
      column.used += gap + size.y();
      return at;
    }
    const double x = columns.empty() ? 0 : used + gap;
    if (!fits(size, {bed_width - x, height})) return std::nullopt;
    columns.push_back({x, size.x(), size.y()});
    used = x + size.x();
    return Vector2d(x, y);
  }
};

struct Bed {
  std::vector<Shelf> shelves;

  std::optional<Vector2d> take(const Vector2d& size, const Vector2d& bed, double gap) {
    for (Shelf& shelf : shelves) {
      if (const auto at = shelf.take(size, bed.x(), gap)) return at;
    }
    const double y = shelves.empty() ? 0 : shelves.back().y + shelves.back().height + gap;
    if (!fits(size, {bed.x(), bed.y() - y})) return std::nullopt;
    shelves.push_back({y, size.y(), 0, {}});
    return shelves.back().take(size, bed.x(), gap);
  }
};

}  // namespace

bool fits_bed(const LayoutBox& box, const Vector2d& bed_mm) {
  return fits(box.size_mm, bed_mm) || (box.may_turn && fits(turned(box.size_mm), bed_mm));
}

std::vector<LaidOut> lay_out(const std::vector<LayoutBox>& boxes, const Vector2d& bed_mm,
                             double gap_mm) {
  assert(std::all_of(boxes.begin(), boxes.end(), [&](auto& box) { return fits_bed(box, bed_mm); }));
  std::vector<LaidOut> laid(boxes.size());
  std::vector<Vector2d> sizes;
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    laid[b].turned = !fits(boxes[b].size_mm, bed_mm);
    sizes.push_back(laid[b].turned ? turned(boxes[b].size_mm) : boxes[b].size_mm);
  }
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sizes[a].y() > sizes[b].y() + kRounding_mm;
  });
  std::vector<Bed> beds;
  for (const std::size_t b : order) {
    for (std::size_t bed = 0;; ++bed) {
      if (bed == beds.size()) beds.emplace_back();
      const auto at = beds[bed].take(sizes[b], bed_mm, gap_mm);
      if (!at) continue;
      laid[b].bed = static_cast<int>(bed);
      laid[b].at_mm = *at;
      break;
    }
  }
  return laid;
}

double sheet_width_mm(const std::vector<LayoutBox>& boxes, double gap_mm) {
  constexpr double kLoose = 1.2;  // room that shelves leave
  std::vector<double> widths;
  double area = 0;
  for (const LayoutBox& box : boxes) {
    widths.push_back(box.size_mm.x());
    area += (box.size_mm.x() + gap_mm) * (box.size_mm.y() + gap_mm);
  }
  std::sort(widths.begin(), widths.end(), std::greater<>());
  double width = widths[0];
  if (widths.size() > 1) width += gap_mm + widths[1];
  return std::max(width, std::sqrt(kLoose * area));
}

}  // namespace misalign::schema
