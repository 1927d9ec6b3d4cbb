// Divides the axes of pin hinges into knuckles, which both plates have in turn.
#pragma once

#include <array>
#include <vector>

#include "schema/kit/kit_bores.hpp"

namespace misalign::schema {

/// A knuckle between two places on a side of a panel, from the panel's corner on.
struct Knuckle {
  double from_mm, to_mm;
};

/// The knuckles of a panel on one of its sides, in the side's direction. An axis has an odd number
/// of knuckles, at least three, where both contours lie beside it, with clearances between them and
/// beside the first and the last; the crease's left panel has the first. UserError (bad_request) if
/// they have no room.
std::vector<Knuckle> knuckles_on(const solver::Sheet& sheet, int facet, std::size_t side,
                                 const KitFittings& fittings, double clearance_mm);

inline constexpr double kKnuckle_mm = 8;       ///< length of a knuckle that is aimed at
inline constexpr double kLeastKnuckle_mm = 2;  ///< least length

}  // namespace misalign::schema
