// Writes the clearance of springs as JSON.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/contact.hpp"

namespace misalign::schema {

/// [row, column] of a panel.
Json place_of_panel(const Pattern& base, const solver::Panels& panels, int panel);

/// "springs A10-A16 and A9-A17", "spring A10-A16 and panel [2,3]".
std::string meeting_text(const Pattern& base, const solver::Panels& panels,
                         const std::vector<solver::Diagonal>& diagonals,
                         const solver::SpringMeeting& met);

/// The clearances, pairs that touch, and distances of axes as arrays; null where springs were not
/// judged.
Json spring_clearance_json(const Pattern& base, const solver::Panels& panels,
                           const solver::ContactStudy& study);

}  // namespace misalign::schema
