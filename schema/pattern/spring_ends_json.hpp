// Where springs end, as pattern files and campaigns say it.
#pragma once

#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// "springs": {"attach": "vertices"}, or {"attach": {"inset_mm": 6, "offset_mm": 0, "points":
/// [...]}}, of the pattern whose sheet and holes are read already. What is wrong is a fault: ends
/// outside their panels too.
void read_spring_ends(ObjectReader& reader, Pattern& pattern);
Json spring_ends_json(const Pattern& pattern);

}  // namespace misalign::schema
