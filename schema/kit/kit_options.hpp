// Options of a kit to cut.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "schema/exchange/length_unit.hpp"
#include "schema/nesting/nest_shape.hpp"
#include "schema/pattern/design.hpp"
#include "solver/play/joint_parts.hpp"

namespace misalign::schema {

/// Places of a kit's spring ends, where the pattern has none of its own (solver::SpringEnds).
enum class SpringAt {
  vertex,  ///< the diagonals' vertices: tabs and ball joints
  panel,   ///< bores inside panels near these vertices
};

/// Plates whose hinges lie within them or on their faces.
struct PlateOptions {
  double thickness_mm = 0;
  double spacer_mm = 0;     ///< thickness of spacers between offset plates and their films
  double trim_mm = 0;       ///< trim of corners where plates meet in a point (plate_thickness.hpp)
  double film_mm = 0;       ///< free length of films, the least gap
  double barrel_mm = 0;     ///< outer diameter of pins' barrels
  double clearance_mm = 0;  ///< distance of parts that would touch
  double pin_mm = 1;        ///< diameter of pins, in printed knuckles
  double film_thickness_mm = 0, slot_mm = 5;  ///< printed slots: of this film, so deep
  bool allows_misfit = false;  ///< true if hinges on faces may miss by more than kMostMisfit
};

struct KitOptions {
  CreaseCut crease = CreaseCut::score;
  double kerf_mm = 0;                                   ///< width of material that a cut removes
  double dash_mm = 4, bridge_mm = 1;                    ///< sizes of a perforation after cutting
  std::optional<double> joint_bore_mm, spring_bore_mm;  ///< diameters
  std::optional<solver::JointParts> joints;             ///< given where a design has a kind
  std::optional<double> ball_mm;          ///< diameter of printed balls; none: thickness
  std::optional<SpringAt> spring_at;      ///< default: vertex
  std::optional<PlateOptions> plates;     ///< given where creases are hinges of plates
  double bore_edge_mm = 2;                ///< least distance of a bore from edges and other bores
  double gap_mm = 5;                      ///< distance between parts
  double margin_mm = 5;                   ///< round all parts
  std::optional<Eigen::Vector2d> bed_mm;  ///< width and height of the machine's
  double bond_mm = 8;                     ///< width of rubber plates' bonds along each edge
  bool test_piece = false;                ///< true if pieces to cut first are drawn, too
  NestTurns turns = NestTurns::any;
  LengthUnit unit = LengthUnit::millimetre;  ///< unit of files
  std::optional<double> from_deg;            ///< angle of use; none: D
};

}  // namespace misalign::schema
