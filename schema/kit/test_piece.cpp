#include "schema/kit/test_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "schema/kit/part_item.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kLeastSide_mm = 30, kText_mm = 2.5;

class TestPiece {
 public:
  explicit TestPiece(const KitOptions& options)
      : options_(options),
        from_corner_mm_(std::numbers::sqrt2 *
                        (0.5 * options.joint_bore_mm.value_or(0) + options.bore_edge_mm)),
        side_mm_(std::max(kLeastSide_mm, 4 * from_corner_mm_)),
        item_(empty_item({0, 0}, {0, 0})) {}

  LineDrawing drawing(const std::string& title) {
    const double apart_mm = options_.gap_mm + options_.kerf_mm;
    const bool is_cut = are_apart(options_.crease);
    const double second_mm = side_mm_ + (is_cut ? apart_mm : 0);  // where the second square begins
    const Vector2d corner(second_mm + side_mm_, side_mm_),
        third = corner + Vector2d(apart_mm, apart_mm);
    if (is_cut) {
      cut({0, 0}, {side_mm_, side_mm_});
      cut({second_mm, 0}, corner);
    } else {
      cut({0, 0}, corner);
      crease({side_mm_, 0}, {side_mm_, side_mm_});
    }
    cut(third, third + Vector2d(side_mm_, side_mm_));
    bore(corner, -1);
    bore(third, 1);
    const std::string words[] = {
        title,
        fmt::format("test piece (mm); kerf {:g}; squares of {:g}", options_.kerf_mm, side_mm_),
        "fold the crease; tie the corners"};
    double below_mm = 0;
    for (const std::string& line : words) {
      below_mm += 2 * kText_mm;
      item_.on(KitLayer::note).texts.push_back({{0, -below_mm}, line, kText_mm});
    }
    LineDrawing drawing = item_.drawing;
    const Vector2d margin_mm = Vector2d::Constant(options_.margin_mm + options_.kerf_mm);
    drawing.title = title;
    drawing.least_mm = Vector2d(0, -below_mm) - margin_mm;
    drawing.most_mm = third + Vector2d(side_mm_, side_mm_) + margin_mm;
    std::erase_if(drawing.layers, [](const LineLayer& layer) { return layer.is_empty(); });
    return drawing;
  }

 private:
  void cut(const Vector2d& least, const Vector2d& most) {
    const Vector2d offset = Vector2d::Constant(0.5 * options_.kerf_mm), from = least - offset,
                   to = most + offset;
    item_.on(KitLayer::cut)
        .paths.push_back({{from, {to.x(), from.y()}, to, {from.x(), to.y()}}, true});
  }
  void crease(const Vector2d& from, const Vector2d& to) {
    if (options_.crease == CreaseCut::score) {
      item_.on(KitLayer::score_valley).paths.push_back({{from, to}, false});
    } else {
      item_.on(KitLayer::dash_valley).paths = perforation(from, to, options_);
    }
  }
  // Adds a bore on a square's diagonal; the square lies on `side` of its corner.
  void bore(const Vector2d& corner, double side) {
    if (!options_.joint_bore_mm) return;
    const Vector2d at = corner + side * from_corner_mm_ / std::numbers::sqrt2 * Vector2d(1, 1);
    item_.on(KitLayer::bore)
        .circles.push_back({at, 0.5 * (*options_.joint_bore_mm - options_.kerf_mm)});
  }

  const KitOptions& options_;
  const double from_corner_mm_, side_mm_;
  KitItem item_;
};

}  // namespace

LineDrawing kit_test_piece(const KitOptions& options, const std::string& title) {
  return TestPiece(options).drawing(title);
}

}  // namespace misalign::schema
