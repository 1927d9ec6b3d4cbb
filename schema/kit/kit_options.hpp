// Options of a kit to cut.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Where the springs of a kit end, unless the pattern says it itself (solver::SpringEnds).
enum class SpringAt {
  vertex,  ///< on the vertices of their diagonals: in tabs, and in ball joints
  panel,   ///< in bores inside panels near these vertices
};

struct KitOptions {
  CreaseCut crease = CreaseCut::score;
  double kerf_mm = 0;                                   ///< what the beam or the mill takes away
  double dash_mm = 4, bridge_mm = 1;                    ///< of a perforation, as they come out
  std::optional<double> joint_bore_mm, spring_bore_mm;  ///< diameters
  std::optional<SpringAt> spring_at;                    ///< on vertices where nobody says it
  double bore_edge_mm = 2;  ///< what is left between a bore and an edge, or another bore
  double gap_mm = 5;        ///< between parts
  double margin_mm = 5;     ///< round all of them
  std::optional<Eigen::Vector2d> bed_mm;  ///< width and height of the machine's
  bool guide = false;                     ///< with a page to build it by
  bool test_piece = false;                ///< with one hinge and one ball joint to be cut first
};

}  // namespace misalign::schema
