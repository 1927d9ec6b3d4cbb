// A folded sheet with springs before its release: the input of other programs that simulate it.
#pragma once

#include <string>
#include <vector>

#include "schema/pattern/pattern_file.hpp"
#include "solver/model/panels.hpp"
#include "solver/motion/plates.hpp"

namespace misalign::schema {

/// Description of the units for files.
inline constexpr const char* kSimulatedUnits =
    "units: mm, t (1000 kg), s; forces in N, energies in N mm (mJ), stresses in N/mm^2 (MPa)";

/// Its springs end on the vertices. Units are consistent: mm, t, s and N.
struct SimulatedSheet {
  std::string title;
  solver::Mechanism mechanism;
  solver::Panels panels;
  std::vector<std::array<int, 2>> places;  ///< row and column of each panel
  solver::FlatVertices flat_mm;
  double pilot_deg;                    ///< pilot angle at the start
  Eigen::Matrix3Xd start_mm;           ///< 3 x vertices
  std::vector<double> fold_angle_deg;  ///< each crease at the start, valleys positive
  solver::Plates plates;
  double stiffness_n_per_mm;
  double rest_deg;           ///< the pilot angle at which all springs are relaxed
  Eigen::Matrix3Xd rest_mm;  ///< the vertices there

  double relaxed_mm(const solver::Diagonal& diagonal) const {
    return (rest_mm.col(diagonal.from) - rest_mm.col(diagonal.to)).norm();
  }
  double start_length_mm(const solver::Diagonal& diagonal) const {
    return (start_mm.col(diagonal.from) - start_mm.col(diagonal.to)).norm();
  }
  /// The first panel that has this vertex for a corner.
  int panel_at(int vertex) const;
  /// Header lines of a program's file; its units come next.
  std::vector<std::string> head() const;
};

}  // namespace misalign::schema
