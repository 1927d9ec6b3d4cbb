// All parts, as the whole program has them.
#pragma once

#include "search/draws/parts.hpp"
#include "search/sheets/front_query.hpp"
#include "search/sheets/optimised_draw.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/study_functions.hpp"

namespace misalign::search {

inline constexpr Parts kWholeProgram{.certifier = draw_certifier,
                                     .ascend = optimised_draw,
                                     .add_study_functions = add_study_functions,
                                     .look_ahead = look_ahead,
                                     .front_sql = front_sql};
/// Nothing is proven where a draw is only made again.
inline constexpr Parts kWithoutProofs{.ascend = optimised_draw};

}  // namespace misalign::search
