// Motion of the panels of a folding sheet, and the inertia of its coordinate.
#pragma once

#include <optional>

#include "solver/model/panels.hpp"
#include "solver/motion/plates.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

/// A sheet in one state. A free sheet moves without momentum and angular momentum, which of all
/// motions with these joints' rates has the least energy (Koenig); otherwise a panel is held.
struct MovingPanels {
  /// Coordinates are those of the first panel (mm from A1; its flat ones); rates are per unit of x.
  struct Panel {
    double mass_t;
    Eigen::Vector3d centre_mm, velocity, spin;
    Eigen::Matrix3d inertia;  ///< about its centre, t mm^2
  };

  std::vector<Panel> panels;
  Eigen::Vector3d frame_spin;  ///< spin of the first panel

  /// T = generalised_mass() / 2 * (dx/dt)^2, in t mm^2.
  double generalised_mass() const;
  /// Centre of mass of the whole sheet, mm.
  Eigen::Vector3d centre_mm() const;
};

class SheetMover {
 public:
  /// `held`: a panel; none: free in space. `shape`, `way` and `panels` must outlive this object.
  SheetMover(const FoldedShape& shape, const FoldingWay& way, const Panels& panels,
             const Plates& plates, std::optional<int> held)
      : shape_(shape),
        way_(way),
        panels_(panels),
        masses_(panel_masses(plates, panels.corners, way.from_a1_mm())),
        held_(held) {}

  /// Moves panels at a state with these rates of all unknowns (rad per unit of x).
  MovingPanels move(const FoldState<double>& state, const double* rates);
  /// Transforms of the last state: the place of a panel's vertex or point (flat, from A1), the
  /// direction of a vector fixed to it, and a point as seen in its flat frame.
  Eigen::Vector3d place_mm(int panel, int vertex) const {
    return place_mm(panel, Eigen::Vector2d(way_.from_a1_mm().col(vertex)));
  }
  Eigen::Vector3d carried_mm(int panel, const Eigen::Vector3d& from_a1_mm) const {
    return turn(panel) * from_a1_mm + shift_mm(panel);
  }
  Eigen::Matrix3d turn(int panel) const;
  Eigen::Vector3d seen_from(int panel, const Eigen::Vector3d& point_mm) const {
    return turn(panel).transpose() * (point_mm - shift_mm(panel));
  }

 private:
  Eigen::Vector3d place_mm(int panel, const Eigen::Vector2d& from_a1_mm) const {
    return turn(panel).leftCols<2>() * from_a1_mm + shift_mm(panel);
  }
  Eigen::Vector3d shift_mm(int panel) const;
  const Pose<double>& pose(int panel) const {
    return points_
        .facets[static_cast<std::size_t>(panels_.facets[static_cast<std::size_t>(panel)])];
  }

  const FoldedShape& shape_;
  const FoldingWay& way_;
  const Panels& panels_;
  const std::vector<PanelMass> masses_;  // centres relative to A1
  const std::optional<int> held_;
  FoldedShape::Points<double> points_;
  std::vector<FoldedShape::Twist<double>> twists_;
};

}  // namespace misalign::solver
