// The study of stress: a sheet of elastic panels let go, whether it deploys and what its panels
// suffer. CalculiX computes it, outside of this program.
#pragma once

#include <optional>
#include <vector>

#include "solver/motion/deployment.hpp"

namespace misalign::solver {

struct StressHistory {
  /// Von Mises stress at a node, and where that is on the flat sheet.
  struct Peak {
    double stress_mpa = 0, time_s = 0;
    int panel = -1;
    Eigen::Vector2d flat_mm = Eigen::Vector2d::Zero();
  };

  bool is_sound = true;  ///< if not, it ends before the first frame that is no result
  /// Of each time that was written: the largest outside the discs, and anywhere.
  std::vector<double> time_s, outside_mpa, anywhere_mpa;
  std::optional<Peak> outside, anywhere;  ///< the largest of all times
  std::vector<double> panel_outside_mpa;  ///< the same of each panel; 0 where nothing is
};

struct StressStudy {
  /// The start, or one increment. A crease's fold angle is the one between its panels' normals,
  /// each the cross product of the panel's diagonals: panels bend.
  struct Row {
    double time_s = 0;
    double pilot_deg = 0;
    double widest_deg = 0;  ///< of all creases, the farthest from flat
    double springs_n_mm = 0, strain_n_mm = 0, kinetic_n_mm = 0;
  };

  std::vector<Row> rows;  ///< up to the deployed one
  StressHistory stress;
  std::optional<double> deployed_s;
  bool was_stopped = false;  ///< by whom it was shown to
  /// Whether ccx gave up before the end of time, or wrote what is no number: a numerical failure.
  bool gave_up = false;
  double cpu_s = 0, memory_mb = 0;
  /// Of the same sheet with rigid panels, from the same start until it is flat or turns round.
  std::vector<Deployment::Row> rigid;

  /// Without what comes after the first row in which every crease is this close to flat.
  void end_where_deployed(double flat_deg);
  /// The rigid motion's pilot angle; none after its end.
  std::optional<double> rigid_pilot_deg(double time_s) const;
};

}  // namespace misalign::solver
