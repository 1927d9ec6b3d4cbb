#include "schema/kit/test_piece.hpp"

#include <algorithm>
#include <cmath>

#include "schema/kit/chords.hpp"
#include "schema/kit/part_item.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kLeastSide_mm = 30;

// An arc round a middle, its ends among the points; counter-clockwise where the turn is positive.
void add_arc(const Vector2d& middle, double radius_mm, double from_deg, double turn_deg,
             Ring& ring) {
  const PlanePoints arc =
      arc_points(middle, radius_mm, from_deg * solver::kRadPerDeg, turn_deg * solver::kRadPerDeg);
  ring.insert(ring.end(), arc.begin(), arc.end());
}

class TestPiece {
 public:
  TestPiece(const KitOptions& options, const PlateEdges& edges)
      : options_(options),
        hinge_(edges.hinge(true)),
        from_corner_mm_(0.5 * options.joint_bore_mm.value_or(0) + options.bore_edge_mm),
        // The disc of a tab reaches as far beyond edges that are set back.
        tab_mm_(
            options.spring_bore_mm
                ? std::hypot(0.5 * *options.spring_bore_mm + options.bore_edge_mm, hinge_.back_mm)
                : 0),
        clear_mm_(tab_mm_ > 0
                      ? std::hypot(tab_mm_, edges.reach_mm()) + kTabSlot_mm + options.kerf_mm
                      : 0),
        side_mm_(std::max({kLeastSide_mm, 4 * from_corner_mm_, 4 * clear_mm_}) + hinge_.back_mm +
                 hinge_.bevel_mm) {}

  LineDrawing drawing(const std::string& title) {
    const double apart_mm = options_.gap_mm + options_.kerf_mm;
    const bool is_cut = are_apart(options_.crease);
    const Vector2d upper(0, side_mm_ + (is_cut ? apart_mm + tab_mm_ : 0)),
        corner = upper + Vector2d(side_mm_, side_mm_),
        third = corner + Vector2d(apart_mm, apart_mm);
    Ring lower_ring = lower(), upper_ring = square_above(upper);
    if (is_cut) {
      cut(lower_ring);
      cut(upper_ring);
      if (hinge_.back_mm > 0 || hinge_.bevel_mm > 0) add_axes(upper);
    } else {
      // One contour: the lower one's from its right side to the tab, then the upper one's.
      lower_ring.erase(lower_ring.begin() + 2);
      if (tab_mm_ == 0) upper_ring.pop_back();  // the lower one's corner, too
      lower_ring.insert(lower_ring.begin() + 2, upper_ring.begin() + 1, upper_ring.end());
      cut(lower_ring);
      crease({clear_mm_, side_mm_}, {side_mm_, side_mm_});
    }
    cut({third, third + Vector2d(side_mm_, 0), third + Vector2d(side_mm_, side_mm_),
         third + Vector2d(0, side_mm_)});
    if (tab_mm_ > 0) bore({0, side_mm_}, *options_.spring_bore_mm);
    if (options_.joint_bore_mm) {
      const Vector2d off = Vector2d::Constant(from_corner_mm_);
      bore(corner - off, *options_.joint_bore_mm);
      bore(third + off, *options_.joint_bore_mm);
    }
    LineDrawing drawing = item_.drawing;
    const Vector2d margin_mm = Vector2d::Constant(options_.margin_mm + options_.kerf_mm);
    drawing.title = title;
    drawing.unit = options_.unit;
    drawing.least_mm = Vector2d(-tab_mm_, 0) - margin_mm;
    drawing.most_mm = third + Vector2d(side_mm_, side_mm_) + margin_mm;
    return without_empty_layers(std::move(drawing));
  }

 private:
  // The lower square, from its lower left corner, with the tab round its upper left one. Its upper
  // edge is set back from the axis.
  Ring lower() const {
    const double edge_mm = side_mm_ - hinge_.back_mm;
    Ring ring = {{0, 0}, {side_mm_, 0}, {side_mm_, edge_mm}};
    if (tab_mm_ > 0) {
      const double from_deg = -std::asin(hinge_.back_mm / tab_mm_) / solver::kRadPerDeg;
      add_arc({0, side_mm_}, tab_mm_, from_deg, 270 - from_deg, ring);
    } else {
      ring.emplace_back(0, edge_mm);
    }
    return ring;
  }
  // The upper square, from its lower right corner, cut clear of the tab at its lower left one.
  Ring square_above(const Vector2d& least) const {
    const double back_mm = hinge_.back_mm;
    Ring ring = {least + Vector2d(side_mm_, back_mm), least + Vector2d(side_mm_, side_mm_),
                 least + Vector2d(0, side_mm_)};
    if (tab_mm_ > 0) {
      const double to_deg = std::asin(back_mm / clear_mm_) / solver::kRadPerDeg;
      add_arc(least, clear_mm_, 90, to_deg - 90, ring);
    } else {
      ring.push_back(least + Vector2d(0, back_mm));
    }
    return ring;
  }
  // The axis beside both squares, and the lines of their bevels.
  void add_axes(const Vector2d& upper) {
    for (const double side : {-1.0, 1.0}) {
      const Vector2d from =
                         side < 0 ? Vector2d(clear_mm_, side_mm_) : upper + Vector2d(clear_mm_, 0),
                     along(side_mm_ - clear_mm_, 0);
      item_.on(KitLayer::hinge).paths.push_back({{from, from + along}, false});
      if (hinge_.bevel_mm == 0) continue;
      const Vector2d in(0, side * (hinge_.back_mm + hinge_.bevel_mm));
      item_.on(KitLayer::score_valley).paths.push_back({{from + in, from + in + along}, false});
    }
  }
  void cut(const Ring& ring) {
    item_.on(KitLayer::cut)
        .paths.push_back({offset_ring(ring, 0.5 * options_.kerf_mm).value(), true});
  }
  void crease(const Vector2d& from, const Vector2d& to) {
    if (options_.crease == CreaseCut::score) {
      item_.on(KitLayer::score_valley).paths.push_back({{from, to}, false});
    } else {
      item_.on(KitLayer::dash_valley).paths = perforation(from, to, options_);
    }
  }
  void bore(const Vector2d& centre_mm, double diameter_mm) {
    item_.on(KitLayer::bore).circles.push_back({centre_mm, 0.5 * (diameter_mm - options_.kerf_mm)});
  }

  const KitOptions& options_;
  const PlateEdge& hinge_;
  const double from_corner_mm_, tab_mm_, clear_mm_, side_mm_;  // distances, radii, a length
  KitItem item_ = empty_item();
};

}  // namespace

LineDrawing kit_test_piece(const KitOptions& options, const PlateEdges& edges,
                           const std::string& title) {
  return TestPiece(options, edges).drawing(title);
}

}  // namespace misalign::schema
