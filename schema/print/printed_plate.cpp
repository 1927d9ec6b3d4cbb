#include "schema/print/printed_plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "schema/files/user_error.hpp"
#include "schema/kit/chords.hpp"
#include "schema/print/knuckles.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using solver::OptionFault;

Vector3d raised(const Vector2d& point, double height_mm) {
  return {point.x(), point.y(), height_mm};
}

// A circle, counter-clockwise or clockwise.
PlanePoints circle(const Vector2d& centre, double radius_mm, double turn_rad) {
  PlanePoints points = arc_points(centre, radius_mm, 0, turn_rad);
  points.pop_back();  // the first again
  return points;
}

// A ring without points that follow one at the same place.
PlanePoints distinct(const PlanePoints& ring) {
  constexpr double kSame_mm = 1e-6;
  PlanePoints points;
  for (const Vector2d& point : ring) {
    if (points.empty() || (point - points.back()).norm() > kSame_mm) points.push_back(point);
  }
  while ((points.front() - points.back()).norm() <= kSame_mm) points.pop_back();
  return points;
}

class PrintedPlate {
 public:
  PrintedPlate(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
               const KitOptions& options)
      : sheet_(sheet),
        facet_(facet),
        fittings_(fittings),
        plates_(*options.plates),
        half_mm_(0.5 * plates_.thickness_mm),
        back_mm_(fittings.edges.back_mm(facet)) {
    if (options.crease == CreaseCut::film) {
      add_slotted();
    } else if (options.crease == CreaseCut::pin) {
      add_knuckled();
    } else {
      add_bevelled();
    }
  }

  Solid solid() && {
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) join(levels_[l], levels_[l + 1]);
    for (const Pin& pin : pins_) add_pin(pin);
    std::vector<PlanePoints> bores;
    for (const Bore& bore : fittings_.bores) {
      if (bore.facet != facet_) continue;
      bores.push_back(circle(bore.centre_mm, 0.5 * bore.diameter_mm, -2 * std::numbers::pi));
      wall(bores.back());
    }
    for (const double side : {1.0, -1.0}) {
      std::vector<PlanePoints> rings = {
          distinct((side > 0 ? levels_.back() : levels_.front()).ring)};
      rings.insert(rings.end(), bores.begin(), bores.end());
      if (side < 0) mirror(rings);
      maker_.add(rings, {0, 0, side * half_mm_}, {side, 0, 0}, {0, 1, 0});
    }
    return std::move(maker_).solid(panel_label(sheet_, facet_));
  }

 private:
  struct Level {
    double height_mm;
    PlanePoints ring;
  };

  static void mirror(std::vector<PlanePoints>& rings) {
    for (PlanePoints& ring : rings) {
      for (Vector2d& point : ring) point.x() = -point.x();
      std::ranges::reverse(ring);
    }
  }

  PlateRing face(PlateFace face) const { return plate_face(sheet_, facet_, fittings_, face); }

  void add_bevelled() {
    levels_.push_back({-half_mm_, face(PlateFace::lower).points});
    levels_.push_back({0, plate_ring(sheet_, facet_, fittings_, back_mm_).value().points});
    levels_.push_back({half_mm_, face(PlateFace::upper).points});
  }

  void add_slotted() {
    const PlanePoints contour = face(PlateFace::upper).points;
    const double slot_mm = 0.5 * (plates_.film_thickness_mm + plates_.clearance_mm);
    levels_.push_back({-half_mm_, contour});
    if (plates_.film_thickness_mm > 0) {
      if (slot_mm > kMostSlot * half_mm_) {
        throw UserError(OptionFault{
            "thickness_mm", fmt::format("{:g}", plates_.thickness_mm),
            fmt::format("too thin for slots of {:g} mm (a film and its clearance)", 2 * slot_mm),
            fmt::format("at least {:g} mm", 2 * slot_mm / kMostSlot)});
      }
      const PlanePoints within = slotted();
      levels_.insert(
          levels_.end(),
          {{-slot_mm, contour}, {-slot_mm, within}, {slot_mm, within}, {slot_mm, contour}});
    }
    levels_.push_back({half_mm_, contour});
  }

  // The ring within the slots, which are less deep where bores have no room else.
  PlanePoints slotted() const {
    constexpr double kLeast_mm = 1;
    for (double depth_mm = plates_.slot_mm; depth_mm >= kLeast_mm; depth_mm *= 0.9) {
      std::array<double, 4> back_mm = back_mm_;
      for (std::size_t k = 0; k < 4; ++k) {
        if (fittings_.edges.edge(facet_, k).crease >= 0) back_mm[k] += depth_mm;
      }
      const auto ring = plate_ring(sheet_, facet_, fittings_, back_mm);
      if (ring && keeps_off_bores(back_mm)) return ring->points;
    }
    throw UserError(
        OptionFault{"slot_mm", fmt::format("{:g}", plates_.slot_mm),
                    fmt::format("panel {} has no room for slots of {:g} mm beside its bores",
                                panel_label(sheet_, facet_), kLeast_mm),
                    "take smaller bores, or a larger " + parameter("bore_edge_mm")});
  }

  // Returns whether lines at these distances from the panel's sides leave bores whole. The bore of
  // a tab is on the panel's corner, outside all slots.
  bool keeps_off_bores(const std::array<double, 4>& back_mm) const {
    const auto& around = sheet_.base().sheet.facets[static_cast<std::size_t>(facet_)];
    return std::ranges::all_of(fittings_.bores, [&](const Bore& bore) {
      if (bore.facet != facet_ || fittings_.tab_at(bore.vertex) != nullptr) return true;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector2d from = sheet_.point_mm(around[k]),
                       along = (sheet_.point_mm(around[(k + 1) % 4]) - from).normalized();
        if (cross(along, bore.centre_mm - from) < back_mm[k] + 0.5 * bore.diameter_mm) return false;
      }
      return true;
    });
  }

  void add_knuckled() {
    pin_mm_ = 0.5 * (plates_.pin_mm + plates_.clearance_mm);
    if (half_mm_ - pin_mm_ < kPinWall_mm) {
      throw UserError(OptionFault{
          "pin_mm", fmt::format("{:g}", plates_.pin_mm),
          fmt::format("leaves less than {:g} mm of material round it in plates of {:g} mm",
                      kPinWall_mm, plates_.thickness_mm),
          fmt::format("thinner pins, or plates of {:g} mm", 2 * (pin_mm_ + kPinWall_mm))});
    }
    const PlateRing contour = face(PlateFace::upper);
    find_pins();
    for (const Vector2d& at :
         arc_points({0, 0}, half_mm_, -std::numbers::pi / 2, std::numbers::pi)) {
      levels_.push_back({at.y(), knuckled(contour, at.x())});
    }
    levels_.front().height_mm = -half_mm_;
    levels_.back().height_mm = half_mm_;
  }

  // Places the plate's knuckles on its axes.
  void find_pins() {
    const auto& around = sheet_.base().sheet.facets[static_cast<std::size_t>(facet_)];
    for (std::size_t k = 0; k < 4; ++k) {
      if (fittings_.edges.edge(facet_, k).crease < 0) continue;
      const Vector2d from = sheet_.point_mm(around[k]),
                     along = (sheet_.point_mm(around[(k + 1) % 4]) - from).normalized(),
                     inwards(-along.y(), along.x());
      for (const Knuckle& knuckle :
           knuckles_on(sheet_, facet_, k, fittings_, plates_.clearance_mm)) {
        pins_.push_back({from + knuckle.from_mm * along, from + knuckle.to_mm * along, inwards,
                         back_mm_[k], k});
      }
    }
  }

  // The contour with knuckles that reach beyond the axis by some distance. Notes which of its lines
  // are ends of knuckles.
  PlanePoints knuckled(const PlateRing& contour, double beyond_mm) {
    PlanePoints ring;
    ends_.clear();
    const auto add = [&](const Vector2d& point, bool begins_end) {
      ring.push_back(point);
      ends_.push_back(begins_end);
    };
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      add(contour.points[i], false);
      for (const Pin& pin : pins_) {
        if (contour.begins[pin.side] != i) continue;
        add(pin.begin + pin.back_mm * pin.inwards, true);
        add(pin.begin - beyond_mm * pin.inwards, false);
        add(pin.end - beyond_mm * pin.inwards, true);
        add(pin.end + pin.back_mm * pin.inwards, false);
      }
    }
    return ring;
  }

  void join(const Level& low, const Level& high) {
    const std::size_t n = low.ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!ends_.empty() && ends_[i]) continue;
      const std::size_t next = (i + 1) % n;
      maker_.add(raised(low.ring[i], low.height_mm), raised(low.ring[next], low.height_mm),
                 raised(high.ring[next], high.height_mm), raised(high.ring[i], high.height_mm));
    }
  }

  // A knuckle: where it begins and ends on the axis, and its distance from the plate.
  struct Pin {
    Vector2d begin, end, inwards;
    double back_mm;
    std::size_t side;
  };

  // Adds both ends of a knuckle, and the wall of its bore.
  void add_pin(const Pin& pin) {
    PlanePoints end;  // x into the plate, y up; counter-clockwise
    for (const Level& level : levels_) {
      end.emplace_back(pin.back_mm, level.height_mm);
    }
    for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) {
      const double height_mm = level->height_mm;
      end.emplace_back(-std::sqrt(std::max(0.0, half_mm_ * half_mm_ - height_mm * height_mm)),
                       height_mm);
    }
    const PlanePoints bore = circle({0, 0}, pin_mm_, -2 * std::numbers::pi);
    const Vector3d inwards = raised(pin.inwards, 0), up = Vector3d::UnitZ();
    std::vector<PlanePoints> rings = {end, bore};
    maker_.add(rings, raised(pin.end, 0), inwards, up);
    mirror(rings);
    maker_.add(rings, raised(pin.begin, 0), -inwards, up);
    const auto at = [&](const Vector2d& from, const Vector2d& point) -> Vector3d {
      return raised(from, 0) + point.x() * inwards + point.y() * up;
    };
    for (std::size_t i = 0; i < bore.size(); ++i) {
      const Vector2d &p = bore[i], &q = bore[(i + 1) % bore.size()];
      maker_.add(at(pin.begin, p), at(pin.begin, q), at(pin.end, q), at(pin.end, p));
    }
  }

  // Adds the wall of a bore between both faces; its circle is clockwise.
  void wall(const PlanePoints& bore) {
    for (std::size_t i = 0; i < bore.size(); ++i) {
      const Vector2d &p = bore[i], &q = bore[(i + 1) % bore.size()];
      maker_.add(raised(p, -half_mm_), raised(q, -half_mm_), raised(q, half_mm_),
                 raised(p, half_mm_));
    }
  }

  const solver::Sheet& sheet_;
  const int facet_;
  const KitFittings& fittings_;
  const PlateOptions plates_;
  const double half_mm_;
  const std::array<double, 4> back_mm_;
  double pin_mm_ = 0;  // radius of a pin's bore
  std::vector<Level> levels_;
  std::vector<bool> ends_;  // true: the line after this point is the end of a knuckle
  std::vector<Pin> pins_;
  SolidMaker maker_;
};

}  // namespace

Solid printed_plate(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
                    const KitOptions& options) {
  return PrintedPlate(sheet, facet, fittings, options).solid();
}

}  // namespace misalign::schema
