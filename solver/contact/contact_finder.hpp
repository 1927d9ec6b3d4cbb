// Finds the first contact of panels on a folding way, at any angle, and their distances before.
// Panels have no thickness here; plate_thickness.hpp adds it.
#pragma once

#include <optional>
#include <vector>

#include "solver/contact/gap_walk.hpp"
#include "solver/model/panel_pairs.hpp"

namespace misalign::solver {

/// Panels this close touch. Errors of the shapes are smaller (results/deployment/contact.md).
inline constexpr double kTouch_mm = 1e-6;

struct Contact {
  PanelPair pair;
  double x, pilot_deg;
  /// Place on either panel, on the flat sheet as drawn: the middle of a crease; of a common vertex
  /// a point on the ray.
  Eigen::Vector2d on_a_mm, on_b_mm;
};

class ContactFinder {
 public:
  /// The least distances at one place.
  struct Clearance {
    double apart_mm;    ///< least, of panels without a common vertex; infinity: none
    double vertex_deg;  ///< angle between panels with one common vertex, seen from it
    double crease_deg;  ///< 180 less the largest |fold angle|
    int apart;          ///< pair of apart_mm; -1: none
  };

  /// The sheet must outlive this object.
  ContactFinder(const Panels& panels, const PanelMotion& motion, double touch_mm = kTouch_mm);

  /// The first contact up to `end` (x), where the motion is resolved: GapWalk's bounds make certain
  /// that no panels meet before. Panels meet where they come within touch_mm.
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
