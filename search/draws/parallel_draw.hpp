// Draws members of a base's parallel family.
#pragma once

#include <cstdint>

#include "schema/campaign/misalignment.hpp"

namespace misalign::search {

/// Number of tries for a member with like signs, before the last one is taken.
inline constexpr std::uint32_t kMostTries = 1024;

/// Writes the shifts of draw d in mm: x and y of each of the misalignment's vertices in its order.
/// Coordinate k of try t takes word k of the stream, from block t x ceil(coordinates / 4) on:
/// uniform, times the amplitude. On a grid it is uniform among those multiples of the step that
/// keep the shifts, with the coordinates before it, within the amplitude. For like signs the
/// epsilon of a hole takes the sign of its delta if both are coordinates, and the first try with
/// like signs at every hole counts. A member that shifts a vertex farther than the amplitude along
/// x or y is scaled down as a whole, and stays a member.
void draw_member(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream);

}  // namespace misalign::search
