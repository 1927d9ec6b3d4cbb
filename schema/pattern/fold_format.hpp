// Reads quadrilateral meshes of degree-4 vertices from FOLD 1.2, the crease-pattern file format.
#pragma once

#include <optional>

#include "schema/files/input.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// A mesh with its missing faces filled in.
struct FoldMesh {
  solver::CreasePattern sheet;  ///< the file's faces in its order, then the missing ones
  std::vector<int> missing;     ///< facets that the file lacks: each a single quadrilateral
  /// Per edge, seen from +z of the sheet: +1 valley, -1 mountain; 0 on the perimeter, where it is
  /// unassigned, and where an edge of a missing face is neither.
  std::vector<int> assignment;
  std::vector<std::string> reading;  ///< sentences: how the file was taken
};

/// Reads the crease pattern of a FOLD object (crease_pattern_frame), which lies in any plane. A
/// sheet that does not lie across z is seen from the side from which its faces run
/// counter-clockwise; mountains and valleys are those of that side in any case. Without
/// faces_vertices every region that the edges enclose is a face, but those that edges "B" or "C",
/// borders of one face, part from the others: those are missing. Without edges_assignment every
/// edge is unassigned. Coordinates are in mm times `mm_per_unit`, unless the file names a
/// frame_unit. Faults name the vertex ("A5" is the fifth), edge or face; the mesh is usable only
/// when none was added: a disk of convex quadrilaterals, without crossings, its interior vertices
/// of degree four, its creases mountain, valley or unassigned.
FoldMesh read_fold(const Json& value, const std::string& where, std::optional<double> mm_per_unit,
                   InputFaults& faults);

/// A whole mesh as a FOLD object: reading it again gives the same sheet and assignment.
Json fold_json(const solver::CreasePattern& sheet, const std::vector<int>& assignment);

}  // namespace misalign::schema
