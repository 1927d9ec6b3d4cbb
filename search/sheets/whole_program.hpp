// All parts, as the whole program has them.
#pragma once

#include "search/draws/parts.hpp"
#include "search/sheets/front_query.hpp"
#include "search/sheets/optimised_draw.hpp"
#include "search/sheets/row_certifier.hpp"
#include "search/sheets/shaped_draw.hpp"
#include "search/sheets/study_functions.hpp"

namespace misalign::search {

/// The ascent of an optimising search, or the descent of one among sheets of one shape.
inline std::unique_ptr<DrawAscent> ascent_of(const schema::Campaign& campaign,
                                             const solver::Model& model, schema::Candidate start) {
  return campaign.search.shape ? shaped_draw(campaign, model, std::move(start))
                               : optimised_draw(campaign, model, std::move(start));
}

inline constexpr Parts kWholeProgram{.certifier = draw_certifier,
                                     .ascend = ascent_of,
                                     .add_study_functions = add_study_functions,
                                     .look_ahead = look_ahead,
                                     .front_sql = front_sql};
/// Nothing is proven where a draw is only made again.
inline constexpr Parts kWithoutProofs{.ascend = ascent_of};

}  // namespace misalign::search
