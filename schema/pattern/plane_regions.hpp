// Finds the regions of the plane that straight edges enclose, and which of them are faces of a
// sheet.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// A region by its vertices, which go round it with the region on the left.
struct PlaneRegion {
  std::vector<int> loop;
  double twice_area;  ///< positive, except for the outside of connected edges
  bool bounded() const { return twice_area > 0; }
};

/// Returns regions by walking round each of them from the sides (first to second vertex) that
/// `starts` accepts, in the order of the edges. Edges must not cross.
std::vector<PlaneRegion> regions_of(const PlanePoints& points, const PlaneEdges& edges,
                                    const std::function<bool(const std::pair<int, int>&)>& starts);

/// Faces among the regions of a FOLD file without faces. An edge "B" is a border, "C" a cut: one of
/// its sides is a face, the other a hole or the outside. Any other edge has faces on both sides, or
/// holes. A region that touches the outside is a face.
struct FacesOfRegions {
  std::vector<std::array<int, 4>> faces;  ///< ascending, each begins with its least vertex
  std::vector<std::vector<int>> not_four_sided;
  /// Edges "B" or "C" between two faces or two holes by the other edges, and other edges between a
  /// face and a hole.
  std::vector<std::pair<int, int>> contradictions;
};
FacesOfRegions faces_of_edges(const PlanePoints& points, const PlaneEdges& edges);

}  // namespace misalign::schema
