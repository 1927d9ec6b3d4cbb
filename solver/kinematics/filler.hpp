// Makes fillers for readers that know hinges only: two triangles in the corner of a hole join the
// panels beside it, which share only a vertex, by three hinges through that vertex. Like a ball
// joint they have three degrees of freedom.
//
// Each triangle has half of the flat corner's angle. They can follow the panels while the corner is
// no wider than when flat: their common edge then makes half of the flat angle with either side,
// above or below. The four angles of a quadrilateral with straight sides add up to 360 degrees when
// flat, and to less in any other shape: in every state of every hole two opposite corners are
// narrower than when flat, those that face the shortened diagonal. If diagonals are monotone, these
// corners stay the same.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

struct Filler {
  struct Folded {
    Eigen::Vector3d apex_mm;
    /// Fold angles of the edges before-corner, corner-apex, corner-after: degrees within +-180,
    /// valleys positive.
    std::array<double, 3> angle_deg;
  };

  int hole;           ///< facet
  int corner;         ///< vertex of a ball joint
  int before, after;  ///< the hole's corners next to it, counter-clockwise: before, corner, after
  int from, to;       ///< the panels (facets) beyond before-corner and corner-after
  int way = 1;        ///< +1: the middle hinge rises above the plane of the three, seen from above

  /// Both triangles, counter-clockwise, where `apex` is the number of their common vertex.
  std::array<std::array<int, 3>, 2> triangles(int apex) const {
    return {{{before, corner, apex}, {corner, after, apex}}};
  }
};

/// The filler of a hole's corner that is a ball joint; none of another corner.
std::optional<Filler> filler_at(const PerforatedSheet& base, int hole, int corner);

/// Common vertex of the triangles on the flat sheet: on the bisector, half way to the line from
/// `before` to `after`.
Eigen::Vector2d flat_apex_mm(const Filler& filler, const FlatVertices& vertices_mm);

/// The filler on a folded sheet (3 x vertices) whose corner is no wider than when flat.
Filler::Folded folded_filler(const Filler& filler, const PerforatedSheet& base,
                             const FlatVertices& vertices_mm, const Eigen::Matrix3Xd& shape_mm);

/// The fewest fillers that join all panels, with the mechanism's creases, into one tree and can
/// follow all these shapes of a sheet. First come those whose hinges stay mountains or valleys
/// throughout, then those that fold least. None if there are no such fillers.
std::optional<std::vector<Filler>> joining_fillers(
    const PerforatedSheet& base, const Mechanism& mechanism, const FlatVertices& vertices_mm,
    const std::vector<const Eigen::Matrix3Xd*>& shapes_mm);

}  // namespace misalign::solver
