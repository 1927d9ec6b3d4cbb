// Draw d of a campaign: a pure function of (seed, d).
#pragma once

#include <array>
#include <cstdint>

#include "schema/campaign/campaign.hpp"

namespace misalign::search {

/// Philox4x32-10 (Random123), key = (low, high half of the seed), counter = (low, high half of the
/// draw, block, stream). Stream 0 is draws; 1 is miscut copies and 2 loose joints, with the trial
/// in the draw's place; 3 is splitting, see StepWords; the rest is reserved.
inline constexpr std::uint32_t kDrawStream = 0, kToleranceStream = 1, kBacklashStream = 2,
                               kSplittingStream = 3;
std::array<std::uint32_t, 4> philox_block(std::uint64_t seed, std::uint64_t draw,
                                          std::uint32_t block, std::uint32_t stream);

/// floor(3 w / 2^32) - 1.
int ternary_level(std::uint32_t word);
/// (w + 0.5) / 2^31 - 1, on (-1, 1).
double uniform_share(std::uint32_t word);

/// Shifts of draw d, mm: x and y of each vertex that the misalignment names, in its order. The k-th
/// vertex takes words 2k (x) and 2k + 1 (y), ternary or uniform, times the amplitude; or they are a
/// member of the parallel family (parallel_draw).
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream = kDrawStream);

/// The same into the columns of these vertices (2 x vertices of the sheet); the others are left
/// alone.
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 Eigen::Matrix2Xd& shifts_mm);

/// Shifts of draw d of a campaign, one column per vertex of its sheet.
Eigen::Matrix2Xd shifts_of_draw(const schema::Campaign& campaign, std::uint64_t draw);

/// Whether a draw of the campaign can have these shifts, one column per vertex of its sheet.
bool can_be_drawn(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm);

/// Whether the generator gives the published known answers (Random123's, and seed 1 draw 0).
bool random_numbers_as_published();

}  // namespace misalign::search
