// Draw d of a campaign: a pure function of (seed, d).
#pragma once

#include <array>
#include <cstdint>

#include "schema/campaign/campaign.hpp"
#include "solver/kinematics/loose_sheet.hpp"

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
/// vertex takes words 2k (x) and 2k + 1 (y), ternary or uniform, times the amplitude.
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

/// The k-th point of trial t, uniform in the unit ball: the first in the ball of points of the cube
/// round it, whose coordinates are uniform ones as above from words 0 to 2 of blocks 64 k,
/// 64 k + 1, ... (One in two lies in it.)
solver::Vec3<double> point_in_ball(std::uint64_t seed, std::uint64_t trial, std::uint32_t k);

/// How the joints of trial t have settled, as a share of their play: points 2i and 2i + 1 are
/// crease i's at a and at b, in the mechanism's order, and then those of the ball joints.
solver::JointOffsets trial_offsets(const solver::Mechanism& mechanism, std::uint64_t seed,
                                   std::uint64_t trial);

/// Whether the generator gives the published known answers (Random123's, and seed 1 draw 0).
bool random_numbers_as_published();

}  // namespace misalign::search
