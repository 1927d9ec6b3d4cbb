// Finds the best preload of springs of several rates, by linear bending.
#pragma once

#include <span>
#include <vector>

#include "search/sheets/card_lines.hpp"

namespace misalign::search {

/// Springs of a rate with the preload with which the least static friction over the way is largest
/// (solver::best_preload), and that friction.
struct PreloadedSprings {
  double stiffness_n_per_mm, preload_n, static_n_mm_per_mm;
};

/// One for each rate, in their order, on the diagonals that have springs. None for a filling that
/// is no springs, or is relaxed at a stop, and where the panels' stiffness is not positive.
std::vector<PreloadedSprings> preloaded_springs(const CardSheet& on,
                                                std::span<const double> rates_n_per_mm);
/// The design with these springs, their preload rounded to two digits.
schema::Design with_springs(schema::Design design, const PreloadedSprings& springs);

}  // namespace misalign::search
