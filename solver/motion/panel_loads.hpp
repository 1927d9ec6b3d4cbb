// Loads on each panel of a sheet besides its joints' reactions: filling, weight, inertia, and the
// resistance of creases and ball joints.
#pragma once

#include "solver/motion/deployment.hpp"
#include "solver/motion/filling_forces.hpp"
#include "solver/motion/moving_mass.hpp"

namespace misalign::solver {

class PanelLoads {
 public:
  /// A crease of the posed sheet, in the coordinates of the first panel.
  struct Hinge {
    Eigen::Vector3d middle_mm, axis, one, other;  ///< axis from a to b, two normals to it
    double length_mm;
  };

  /// Force and moment about its centre.
  static constexpr int kOfPanel = 6;

  /// Loads `in_motion` include inertia and joint resistance. Arguments must outlive this object.
  PanelLoads(const EnergyModel& sheet, const FoldedShape& shape, const PerforatedSheet& base,
             bool in_motion);

  /// Places the panels as in this row.
  void pose(const Deployment::Row& at);
  /// Loads on the posed sheet: six a panel, N and N mm. The filling pulls with
  /// `filling_forces_n`, or where there are none with those of the rigid sheet.
  Eigen::VectorXd find(const std::optional<Eigen::VectorXd>& filling_forces_n = {});

  const EnergyModel& sheet() const { return sheet_; }
  const FoldingWay& way() const { return way_; }
  const Mechanism& mechanism() const { return way_.mechanism(); }
  Eigen::Index panels() const { return static_cast<Eigen::Index>(panels_.facets.size()); }
  std::optional<int> held() const { return held_; }
  int panel_of(int facet) const { return panels_.panel_of(facet); }
  const std::vector<Hinge>& hinges() const { return hinges_; }
  /// Place of a panel's vertex, mm.
  Eigen::Vector3d place_mm(int panel, int vertex) const { return mover_.place_mm(panel, vertex); }
  /// Adds a force at a place, and a moment, to a panel's six loads.
  void add(int panel, const Eigen::Vector3d& at_mm, const Eigen::Vector3d& force_n,
           const Eigen::Vector3d& moment_n_mm, Eigen::VectorXd& loads) const;

 private:
  struct Moved {
    double rate, acceleration;  // derivatives of x
  };
  void add_inertia(Eigen::VectorXd& loads) const;
  void add_filling(const std::optional<Eigen::VectorXd>& forces_n, Eigen::VectorXd& loads) const;
  void add_carried(Eigen::Index hole, const HoleEnergy& state, Eigen::VectorXd& loads) const;
  Eigen::Matrix3Xd vertices_mm() const;
  void add_joints(Eigen::VectorXd& loads) const;
  void add_weight(Eigen::VectorXd& loads) const;

  const EnergyModel& sheet_;
  const FoldingWay& way_;
  const bool in_motion_;
  const Panels panels_;
  const std::optional<int> held_;
  SheetMover mover_;
  const SmoothTable momenta_;
  const FillingForces forces_;
  double x_ = 0;
  Moved moved_{};
  MovingPanels moving_{};
  std::vector<Hinge> hinges_;
};

}  // namespace misalign::solver
