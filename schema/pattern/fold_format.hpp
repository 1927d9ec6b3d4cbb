// Reads quadrilateral meshes of degree-4 vertices from FOLD 1.2, the crease-pattern file format.
#pragma once

#include <optional>

#include "schema/files/input.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// A mesh with its missing faces filled in.
struct FoldMesh {
  solver::CreasePattern sheet;  ///< the file's faces in its order, then the missing ones
  std::vector<int> missing;     ///< missing facets, each a single quadrilateral
  /// Assignment of each edge, seen from +z of the sheet: +1 valley, -1 mountain; 0 on the
  /// perimeter, if it is unassigned, and for an edge of a missing face that is neither.
  std::vector<int> assignment;
  std::vector<std::string> reading;  ///< sentences about the interpretation of the file
};

/// Reads the crease pattern of a FOLD object (crease_pattern_frame) in any plane. A sheet that does
/// not lie across z is seen from the side from which its faces run counter-clockwise; mountains and
/// valleys are always those of that side. Without faces_vertices every region that edges enclose is
/// a face, except those that edges "B" or "C", borders of one face, part from the others: those are
/// missing. Without edges_assignment every edge is unassigned. Coordinates are in mm times
/// `mm_per_unit`, unless the file names a frame_unit. Faults name the vertex ("A5" is the fifth),
/// edge or face. Without a fault the mesh is a disk of convex quadrilaterals without crossings; its
/// interior vertices have degree four, its creases are mountain, valley or unassigned.
FoldMesh read_fold(const Json& value, const std::string& where, std::optional<double> mm_per_unit,
                   InputFaults& faults);

/// Writes a whole mesh as a FOLD object: reading it again gives the same sheet and assignment.
Json fold_json(const solver::CreasePattern& sheet, const std::vector<int>& assignment);

}  // namespace misalign::schema
