// Remedies of a card: single changes that meet a requirement which the sheet fails.
//
// Numbers of the design are changed by factors until the requirement is met, and the least such
// change is found by bisection; switches, a construction at the angle of use, and an optimisation
// are tried as they are. Each remedy is checked by a card of its own.
#pragma once

#include "search/sheets/card.hpp"

namespace misalign::search {

/// Returns at most three remedies for each requirement that fails, the smallest change first.
/// `path`: the file of the sheet, or its catalogue, for commands that name it.
std::vector<schema::Remedy> remedies_of(const Subject& subject, const StudiedCard& studied,
                                        const CardOptions& options, const std::string& path);

}  // namespace misalign::search
