// Where the springs of the holes' diagonals end.
#pragma once

namespace misalign::solver {

/// On the vertices of the diagonal (the paper's), or on the panel across the vertex: on the
/// bisector of its corner and off its mid-plane, on the side of +z of the flat sheet. Where a hole
/// lies across it is the panel before the vertex, counter-clockwise round the diagonal's hole.
struct SpringEnds {
  double inset_mm = 0, offset_mm = 0;

  bool at_vertices() const { return inset_mm == 0 && offset_mm == 0; }
  /// Folded up or down, lengths are the same.
  bool in_mid_plane() const { return offset_mm == 0; }
};

}  // namespace misalign::solver
