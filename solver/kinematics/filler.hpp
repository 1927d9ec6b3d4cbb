// Fillers: two triangles in the corner of a hole that tie the panels beside it, which share a
// vertex alone, by three hinges through that vertex. A ball joint turns in three ways, and so do
// they: for readers that know hinges only.
//
// Both triangles take half of the corner's angle, flat. From panel to panel they can follow as long
// as the corner is no wider than when flat: then their common edge lies where half of the flat
// angle is measured from either side, above or below. The four angles of a quadrilateral with
// straight sides add up to 360 degrees when flat, and to less in any other shape: in every state of
// every hole two opposite corners are narrower than when flat, those whose facing diagonal has
// become shorter. Where diagonals are monotone they are the same all the way.
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

  /// The two, counter-clockwise, if the vertex between them has this number.
  std::array<std::array<int, 3>, 2> triangles(int apex) const {
    return {{{before, corner, apex}, {corner, after, apex}}};
  }
};

/// The filler of a hole's corner that is a ball joint; none of another corner.
std::optional<Filler> filler_at(const PerforatedSheet& base, int hole, int corner);

/// Where its triangles meet on the flat sheet: half way to the line from `before` to `after`, on
/// the bisector.
Eigen::Vector2d flat_apex_mm(const Filler& filler, const FlatVertices& vertices_mm);

/// On a folded sheet (3 x vertices) whose corner is no wider than when flat.
Filler::Folded folded_filler(const Filler& filler, const PerforatedSheet& base,
                             const FlatVertices& vertices_mm, const Eigen::Matrix3Xd& shape_mm);

/// Fillers that join all panels, with the mechanism's creases, to one tree, and can follow all of
/// these shapes of a sheet; as few as can be. First come those whose hinges stay mountains or
/// valleys throughout, then those that fold least. None if there are no such fillers.
std::optional<std::vector<Filler>> joining_fillers(
    const PerforatedSheet& base, const Mechanism& mechanism, const FlatVertices& vertices_mm,
    const std::vector<const Eigen::Matrix3Xd*>& shapes_mm);

}  // namespace misalign::solver
