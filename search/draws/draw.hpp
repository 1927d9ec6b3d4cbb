// Makes draw d of a campaign: a pure function of (seed, d).
#pragma once

#include <cstdint>

#include "schema/campaign/campaign.hpp"
#include "search/draws/random_words.hpp"

namespace misalign::search {

/// Writes the shifts of draw d in mm: x and y of each vertex of the misalignment, in its order. The
/// k-th vertex takes words 2k (x) and 2k + 1 (y), ternary or uniform, times the amplitude; or the
/// shifts are a member of the parallel family (parallel_draw).
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream = kDrawStream);

/// Writes the shifts of `draws` draws from `first` on, one after the other.
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t first,
                 std::uint64_t draws, double* shifts_mm);

/// Writes them into the columns of the shifted vertices (2 x vertices of the sheet); the other
/// columns stay unchanged.
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 Eigen::Matrix2Xd& shifts_mm);

/// Returns the shifts of a campaign's draw, one column per vertex of its sheet.
Eigen::Matrix2Xd shifts_of_draw(const schema::Campaign& campaign, std::uint64_t draw);

/// Returns whether a draw of the campaign can have these shifts, one column per vertex; the second,
/// whether a candidate can, which may be an optimum.
bool can_be_drawn(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm);

bool can_be_kept(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm);

}  // namespace misalign::search
