// Places the ends of the springs on the holes' diagonals.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace misalign::solver {

/// Ends lie on the vertices of the diagonal (the paper's), or on the panel across the vertex: on
/// its corner's bisector and above its mid-plane, on the flat sheet's +z side. If a hole lies
/// across the vertex, the panel is that before the vertex, counter-clockwise round the diagonal's
/// hole.
struct SpringEnds {
  /// A spring's end at one corner of a hole. Its place is on a panel that meets the corner,
  /// measured from the vertex: along the bisector of the panel's corner, to its left, up.
  struct Own {
    int hole, vertex, panel;
    Eigen::Vector3d place_mm;
  };

  double inset_mm = 0, offset_mm = 0;
  std::vector<Own> own{};  ///< ends that lie elsewhere; at most one per corner

  bool at_vertices() const { return inset_mm == 0 && offset_mm == 0 && own.empty(); }
  /// True if lengths are the same whether the sheet folds up or down.
  bool in_mid_plane() const {
    return offset_mm == 0 && std::all_of(own.begin(), own.end(),
                                         [](const Own& end) { return end.place_mm.z() == 0; });
  }
};

}  // namespace misalign::solver
