// A base sheet in rational numbers: its vertices, and its creases' fold angles relative to the
// pilot's, exactly.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <string>
#include <vector>

#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

using Rational = boost::multiprecision::cpp_rational;

struct RationalVector {
  Rational x = 0, y = 0;

  friend RationalVector operator-(const RationalVector& a, const RationalVector& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend RationalVector operator+(const RationalVector& a, const RationalVector& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend bool operator==(const RationalVector&, const RationalVector&) = default;
};
inline Rational dot(const RationalVector& a, const RationalVector& b) {
  return a.x * b.x + a.y * b.y;
}
inline Rational cross(const RationalVector& a, const RationalVector& b) {
  return a.x * b.y - a.y * b.x;
}

/// A hypothesis of a proof that does not hold exactly, and its facet or vertex.
struct ProofGap {
  enum class Kind {
    none,
    open_panel,     ///< edges rounded to kProofGrid_mm do not close round the facet
    no_mirror,      ///< the vertex is not two creases in line and two in the mirror about them
    other_folding,  ///< fold angles round the vertex do not agree with its neighbours'
    unlike_turns    ///< opposite edges of the hole, a facet, do not fold alike
  } kind = Kind::none;
  int where = -1;

  /// The gap in words.
  std::string why(const CreasePattern& sheet) const;
};

/// Edges of a base are rounded to this: edges that should be equal differ by less.
inline constexpr double kProofGrid_mm = 1.0 / (1 << 30);

struct RationalBase {
  std::vector<RationalVector> vertices_mm;  ///< A1 at the origin
  /// One per edge: tan^2 of half its fold angle over that of half the pilot's; 0 on the perimeter.
  std::vector<Rational> tangents_sq;
  double off_mm = 0;  ///< largest rounding of an edge, in x or y
  ProofGap gap;       ///< the rest is meaningless if there is a gap
};

/// The base's vertices must all have two creases in line, of opposite signs, and two mirror images
/// about them, of equal signs, as in the family "miura": those in line fold by equal angles, so do
/// the others, and tangents of half the former's angles are cos(sector angle) times those of the
/// latter (Huffman 1976; tests/solver/pattern/degree_four_test.cpp).
RationalBase rational_base(const PerforatedSheet& base);

}  // namespace misalign::solver
