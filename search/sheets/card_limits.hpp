// Keeps what a card requires in an optimisation.
#pragma once

#include "schema/campaign/optimise_bounds.hpp"
#include "search/sheets/card.hpp"

namespace misalign::search {

/// Adds bounds by which the requirements stay met that the sheet's card meets; goals that have a
/// bound keep theirs. UserError as card_of.
void keep_card(const Subject& subject, const CardOptions& copies, schema::OptimiseBounds& bounds);

}  // namespace misalign::search
