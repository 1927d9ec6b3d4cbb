// Options of a kit to cut.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "schema/exchange/length_unit.hpp"
#include "schema/nesting/nest_shape.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Places of a kit's spring ends, where the pattern has none of its own (solver::SpringEnds).
enum class SpringAt {
  vertex,  ///< the diagonals' vertices: tabs and ball joints
  panel,   ///< bores inside panels near these vertices
};

struct KitOptions {
  CreaseCut crease = CreaseCut::score;
  double kerf_mm = 0;                                   ///< width of material that a cut removes
  double dash_mm = 4, bridge_mm = 1;                    ///< sizes of a perforation after cutting
  std::optional<double> joint_bore_mm, spring_bore_mm;  ///< diameters
  std::optional<SpringAt> spring_at;                    ///< default: vertex
  double bore_edge_mm = 2;                ///< least distance of a bore from edges and other bores
  double gap_mm = 5;                      ///< distance between parts
  double margin_mm = 5;                   ///< round all parts
  std::optional<Eigen::Vector2d> bed_mm;  ///< width and height of the machine's
  double bond_mm = 8;                     ///< width of rubber plates' bonds along each edge
  bool test_piece = false;                ///< true if pieces to cut first are drawn, too
  NestTurns turns = NestTurns::any;
  LengthUnit unit = LengthUnit::millimetre;  ///< unit of files
  std::optional<double> from_deg;            ///< angle of use, where tables end; none: D
  bool must_reach =
      false;  ///< true if an angle of use beyond D is refused; otherwise D replaces it
};

}  // namespace misalign::schema
