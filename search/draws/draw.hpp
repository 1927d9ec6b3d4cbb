// Draw d of a campaign: a pure function of (seed, d).
#pragma once

#include <cstdint>

#include "schema/campaign/campaign.hpp"
#include "search/draws/random_words.hpp"

namespace misalign::search {

/// Shifts of draw d, mm: x and y of each vertex that the misalignment names, in its order. The k-th
/// vertex takes words 2k (x) and 2k + 1 (y), ternary or uniform, times the amplitude; or they are a
/// member of the parallel family (parallel_draw).
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 double* shifts_mm, std::uint32_t stream = kDrawStream);

/// The same of draws `first` and so many after it, one after the other.
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t first,
                 std::uint64_t draws, double* shifts_mm);

/// The same into the columns of these vertices (2 x vertices of the sheet); the others are left
/// alone.
void draw_shifts(const schema::Misalignment& misalignment, std::uint64_t seed, std::uint64_t draw,
                 Eigen::Matrix2Xd& shifts_mm);

/// Shifts of draw d of a campaign, one column per vertex of its sheet.
Eigen::Matrix2Xd shifts_of_draw(const schema::Campaign& campaign, std::uint64_t draw);

/// Whether a draw of the campaign can have these shifts, one column per vertex of its sheet; or
/// one of its candidates, which an optimising search has made of it.
bool can_be_drawn(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm);

bool can_be_kept(const schema::Campaign& campaign, const Eigen::Matrix2Xd& shifts_mm);

}  // namespace misalign::search
