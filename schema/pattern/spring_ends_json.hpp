// Reads the ends of springs in pattern files and campaigns.
#pragma once

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Reads "springs": {"attach": "vertices"}, or {"attach": {"inset_mm": 6, "offset_mm": 0, "points":
/// [...]}}, of the pattern whose sheet and holes are read already. Wrong values and ends outside
/// their panels are faults.
void read_spring_ends(ObjectReader& reader, Pattern& pattern);
Json spring_ends_json(const Pattern& pattern);

}  // namespace misalign::schema
