// The axes of springs along a folding way, and walks of their gaps to other springs and to panels.
#pragma once

#include <optional>

#include "solver/contact/gap_walk.hpp"

namespace misalign::solver {

/// The axis of a spring without its ends: the middle part of a line between two points on panels.
struct SpringAxis {
  struct End {
    int panel;
    Eigen::Vector3d place_mm;  ///< flat coordinates of the panel
  };

  int diagonal;
  std::array<End, 2> ends;
  double left_out;  ///< share of its length that is left out at each end, below one half

  /// Both ends of the middle part as seen from a panel, at x; and their rates at a node, of which
  /// those before flat, -1 and so on, are mirror images.
  PolygonCorners seen_from_panel(const PanelMotion& motion, int panel, double x) const;
  PolygonCorners rates_from_panel(const PanelMotion& motion, int panel, int node) const;
};

/// The axis of a diagonal's spring, of which `end_mm` are left out at each end of the flat sheet's.
SpringAxis spring_axis(const Mechanism& mechanism, const Panels& panels,
                       const SheetGeometry<double>& geometry, int diagonal, double end_mm);

/// Walk of the gap between a spring's axis and that of another spring, or a panel's mid-plane.
class SpringWalk : public GapWalk {
 public:
  SpringWalk(const PanelMotion& motion, const SpringAxis& spring, const SpringAxis& other)
      : GapWalk(motion), spring_(spring), other_(other), frame_(other.ends[0].panel) {}
  SpringWalk(const PanelMotion& motion, const SpringAxis& spring, int panel, PolygonCorners outline)
      : GapWalk(motion), spring_(spring), frame_(panel), outline_(std::move(outline)) {}

  double move_to(double x) override;

 protected:
  void find_rates(int node, PolygonCorners& rates) const override;

 private:
  const SpringAxis spring_;
  const std::optional<SpringAxis> other_;
  const int frame_;         // panel from which both are seen
  PolygonCorners outline_;  // the other body, seen from that panel
};

}  // namespace misalign::solver
