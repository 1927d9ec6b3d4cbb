// Finds the first contact of panels on a folding way, at any angle, and how far apart they are
// before. Panels are without thickness; what thickness adds is plate_thickness.hpp's.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/gap_walk.hpp"
#include "solver/model/panel_pairs.hpp"

namespace misalign::solver {

/// Panels this close touch. Above what the shapes are off by (results/deployment/contact.md).
inline constexpr double kTouch_mm = 1e-6;

struct Contact {
  PanelPair pair;
  double x, pilot_deg;
  /// Where on either panel, on the flat sheet as it is drawn; of a crease its middle, of a common
  /// vertex a point on the ray.
  Eigen::Vector2d on_a_mm, on_b_mm;
};

class ContactFinder {
 public:
  /// The least distances at one place.
  struct Clearance {
    double apart_mm;    ///< of panels without a common vertex; infinity if there are none
    double vertex_deg;  ///< angle between panels with one common vertex, seen from it
    double crease_deg;  ///< of the most folded crease from +-180
    int apart;          ///< index of that pair; -1 if there are none
  };

  /// The sheet must outlive this object.
  ContactFinder(const Panels& panels, const PanelMotion& motion, double touch_mm = kTouch_mm);

  /// The first contact up to `end` (x), which lies where the motion is resolved: before it no
  /// panels meet, for certain, as GapWalk bounds it. Those that come within touch_mm without
  /// crossing are said to meet.
  std::optional<Contact> first(double end) const;
  Clearance clearance(double x) const;

 private:
  double vertex_angle_rad(const PanelPair& pair, double x) const;
  Contact contact_of(const PanelPair& pair, const Separation& where, double x) const;
  std::unique_ptr<GapWalk> walk_of(const PanelPair& pair) const;

  const Panels& panels_;
  const PanelMotion& motion_;
  const double touch_mm_;
  const std::vector<PanelPair> pairs_;
};

}  // namespace misalign::solver
