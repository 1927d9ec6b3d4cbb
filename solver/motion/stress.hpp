// The study of stress: whether a released sheet of elastic panels deploys, and the stress in its
// panels. CalculiX computes it, outside of this program.
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/deployment.hpp"

namespace misalign::solver {

struct StressHistory {
  /// Von Mises stress at a node, and its place on the flat sheet.
  struct Peak {
    double stress_mpa = 0, time_s = 0;
    int panel = -1;
    Eigen::Vector2d flat_mm = Eigen::Vector2d::Zero();
  };

  bool is_sound = true;  ///< false: rows end before the first frame that is no result
  /// Largest stress at each time of output, outside the discs and anywhere.
  std::vector<double> time_s, outside_mpa, anywhere_mpa;
  std::optional<Peak> outside, anywhere;  ///< maxima over time
  std::vector<double> panel_outside_mpa;  ///< one per panel; 0 where no node is outside
};

struct StressStudy {
  /// The start, or one increment. A crease's fold angle is the one between its panels' normals,
  /// each the cross product of the panel's diagonals: panels bend.
  struct Row {
    double time_s = 0;
    double pilot_deg = 0;
    double widest_deg = 0;  ///< largest |fold angle| of all creases
    double springs_n_mm = 0, strain_n_mm = 0, kinetic_n_mm = 0;
  };

  std::vector<Row> rows;  ///< up to the deployed one
  StressHistory stress;
  std::optional<double> deployed_s;
  bool was_stopped = false;  ///< the progress callback ended it
  /// True if ccx ended early or wrote NaN: a numerical failure.
  bool gave_up = false;
  double cpu_s = 0, memory_mb = 0;
  /// Motion of the same sheet with rigid panels, from the same start until it is flat or turns
  /// back.
  std::vector<Deployment::Row> rigid;

  /// Removes all after the first row in which every crease is this close to flat.
  void end_where_deployed(double flat_deg);
  /// The rigid motion's pilot angle; none after its end.
  std::optional<double> rigid_pilot_deg(double time_s) const;
};

}  // namespace misalign::solver
