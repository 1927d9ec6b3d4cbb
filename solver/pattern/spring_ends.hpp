// Where the springs of the holes' diagonals end.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace misalign::solver {

/// On the vertices of the diagonal (the paper's), or on the panel across the vertex: on the
/// bisector of its corner and off its mid-plane, on the side of +z of the flat sheet. Where a hole
/// lies across it is the panel before the vertex, counter-clockwise round the diagonal's hole.
struct SpringEnds {
  /// The end of the spring that comes to one corner of a hole: its place on one of the panels that
  /// meet there, from the vertex along the bisector of the panel's corner, to the left of that, and
  /// up.
  struct Own {
    int hole, vertex, panel;
    Eigen::Vector3d place_mm;
  };

  double inset_mm = 0, offset_mm = 0;
  std::vector<Own> own{};  ///< those that end elsewhere; of a corner at most one

  bool at_vertices() const { return inset_mm == 0 && offset_mm == 0 && own.empty(); }
  /// Folded up or down, lengths are the same.
  bool in_mid_plane() const {
    return offset_mm == 0 && std::all_of(own.begin(), own.end(),
                                         [](const Own& end) { return end.place_mm.z() == 0; });
  }
};

}  // namespace misalign::solver
