// Draws of members of a base's parallel family.
#pragma once

#include <cstdint>

#include "schema/campaign/misalignment.hpp"

namespace misalign::search {

/// A member with like signs is looked for this often before a draw is what came last.
inline constexpr std::uint32_t kMostTries = 1024;

/// Shifts of draw d, mm: x and y of each of the misalignment's vertices in its order. Coordinate k
/// of try t takes word k of the stream, from block t x ceil(coordinates / 4) on: uniform, times the
/// amplitude; on a grid uniform among the multiples of its step with which shifts stay within the
/// amplitude beside the coordinates before it. If like signs are asked for, the epsilon of a hole
/// takes the sign of its delta where both are coordinates, and the first try counts in which they
/// are alike at every hole. A member that shifts a vertex farther than the amplitude along x or y
/// is made smaller as a whole: a member still.
void draw_member(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream);

}  // namespace misalign::search
