// The lines of a card about contact of panels and springs.
#pragma once

#include <vector>

#include "search/sheets/card_lines.hpp"

namespace misalign::search {

/// First contact, panel thickness, and clearance of the springs, which have the design's diameter
/// or kSpringDiameter_mm.
std::vector<schema::CardLine> contact_lines(const CardSheet& on);

}  // namespace misalign::search
