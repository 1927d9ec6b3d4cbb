// The model of what a file describes: built once, and passed on to whoever folds its sheets.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "solver/verdict/model.hpp"

namespace misalign::search {

/// A campaign's: its draws shift its misalignment's vertices. Multiples of `look_deg` are looked at
/// between the samples; 0: at none.
solver::Model model_of(const schema::Campaign& campaign, double look_deg = 0);

/// The same for those of its draws that may deploy from `sample` on, with scores.
solver::Model scoring_model_of(const schema::Campaign& campaign, int sample);

/// A pattern's, which has no threshold.
solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       double look_deg = 0);

}  // namespace misalign::search
