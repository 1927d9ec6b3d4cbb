// Builds the perforated sheet as a linkage: creases and ball joints, loops that must close,
// diagonals that are measured. It holds topology only and is built once per campaign; SheetGeometry
// has the vertices, FoldState the rotations of the joints (fold_state.hpp).
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// A fold line between two kept facets: one unknown.
struct Crease {
  int edge;
  int a, b;         ///< its vertices, a < b
  int left, right;  ///< facets seen walking from a to b
  int assignment;   ///< +1 valley, -1 mountain in the base folding, seen from `side`
  int column;       ///< its unknown's column
};

/// A vertex between two opposite holes: three unknowns, a small rotation.
struct BallJoint {
  /// Crossing an edge of the sheet: sense +1 from its left facet to its right one, -1 the other
  /// way.
  struct Crossing {
    int edge;
    int sense;
  };

  int vertex;
  int from_facet, to_facet;
  std::array<Crossing, 2> through;  ///< the base sheet's creases between the two panels
  int column;                       ///< column of its first unknown
};

/// One joint on the way round a loop.
struct Passage {
  bool ball;
  int joint;   ///< index into creases or ball joints
  int sense;   ///< +1 if passed as the joint is defined, else -1
  int vertex;  ///< a point of the sheet that the joint keeps in place
};

/// A closed walk over kept facets. Round a whole vertex the rotation must close, three equations
/// (3.1); round a hole the translation too, six equations (3.4), (3.5).
struct Loop {
  /// The panel that carries a spring's end at a corner of a hole, its vertices before and after the
  /// corner (counter-clockwise), and the first passage that is on it.
  struct Carrier {
    int facet, before, after;
    int arrival;
    /// The end's place from the vertex: along the bisector of the panel's corner, to its left, up.
    Eigen::Vector3d place_mm;
  };

  std::vector<Passage> passages;
  int first_row;
  int rows;                         ///< 3 or 6
  int hole;                         ///< facet index, -1 round a vertex
  std::array<int, 4> corners;       ///< vertices of the hole
  std::array<int, 4> arrival;       ///< the first passage at each corner
  std::array<Carrier, 4> carriers;  ///< carriers of the springs' ends
};

/// A diagonal of a hole, between two corners that its loop passes. Its length is that of its
/// spring, which may end beside them.
struct Diagonal {
  int loop;
  int from_corner, to_corner;  ///< indices, 0 to 3
  int from, to;                ///< vertices
};

struct Mechanism {
  std::vector<Edge> edges;  ///< the sheet's edges, for the axes
  std::vector<Crease> creases;
  std::vector<BallJoint> balls;
  std::vector<Loop> loops;
  std::vector<Diagonal>
      diagonals;  ///< holes in order; (corner 1, corner 3), then (corner 2, corner 0)
  int pilot;      ///< index of the pilot crease; its unknown is the last column
  int vertices;   ///< number of vertices of the sheet
  int unknowns, equations;
  int side;  ///< -1: fold angles are those seen from below, where the pilot is a valley
  double panel_width_mm;
  SpringEnds springs{};

  /// Column of the first of a passage's unknowns, one or three.
  int first_column(const Passage& passage) const {
    return passage.ball ? balls[passage.joint].column : creases[passage.joint].column;
  }
  /// Seen from +z, where fold angles of valleys are positive.
  bool is_valley(const Crease& crease) const { return side * crease.assignment > 0; }
  int diagonal_count() const { return static_cast<int>(diagonals.size()); }
  /// Vertices of a hole in their order: its diagonals lead from the first to the third, and from
  /// the second to the fourth.
  std::array<int, 4> hole_corners(int hole) const {
    assert(hole >= 0 && 2 * hole + 1 < diagonal_count());
    const Diagonal* const both = &diagonals[2 * static_cast<std::size_t>(hole)];
    return {both[0].from, both[1].from, both[0].to, both[1].to};
  }
};

/// Builds joints, loops and diagonals of a sheet whose holes have no hole_faults and leave the
/// pilot whole. Unknowns are creases in edge order, three per ball joint in vertex order, the pilot
/// last.
Mechanism build_mechanism(const PerforatedSheet& base);

}  // namespace misalign::solver
