// Writes the clearance of springs, and raised ends as their remedy, as JSON.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::schema {

/// [row, column] of a panel.
Json place_of_panel(const Pattern& base, const solver::Panels& panels, int panel);

/// "alternate" or "one_above".
const char* offset_name(solver::OffsetKind kind);

/// "springs A10-A16 and A9-A17", "spring A10-A16 and panel [2,3]".
std::string meeting_text(const Pattern& base, const solver::Panels& panels,
                         const std::vector<solver::Diagonal>& diagonals,
                         const solver::SpringMeeting& met);

/// The clearances, pairs that touch, distances of axes as arrays, and "offset_ends" if tried, empty
/// where no springs touch; null where springs were not judged.
Json spring_clearance_json(const Pattern& base, const solver::Panels& panels,
                           const solver::ContactStudy& study);

}  // namespace misalign::schema
