// The regions of the plane that straight edges enclose, and which of them are faces of a sheet.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

/// Vertices round a region, which lies on the left of the way from each to the next.
struct PlaneRegion {
  std::vector<int> loop;
  double twice_area;  ///< positive; for what lies outside of all edges that hang together, not
  bool bounded() const { return twice_area > 0; }
};

/// Regions by walking round each of them from the sides (first to second vertex) that `starts`
/// lets through, in the order of the edges. Edges must not cross.
std::vector<PlaneRegion> regions_of(const PlanePoints& points, const PlaneEdges& edges,
                                    const std::function<bool(const std::pair<int, int>&)>& starts);

/// Which regions of a FOLD file without faces are faces. An edge "B" is a border, "C" a cut: one of
/// its sides is a face, the other a hole or the outside. Any other edge has faces on both sides, or
/// holes; what touches the outside is a face.
struct FacesOfRegions {
  std::vector<std::array<int, 4>> faces;  ///< from their least vertex on, in order
  std::vector<std::vector<int>> not_four_sided;
  /// Edges "B" or "C" with faces on both sides by what the others say, or holes; others with one of
  /// each.
  std::vector<std::pair<int, int>> contradictions;
};
FacesOfRegions faces_of_edges(const PlanePoints& points, const PlaneEdges& edges);

}  // namespace misalign::schema
