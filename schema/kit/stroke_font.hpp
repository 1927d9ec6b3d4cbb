// Words as lines that a machine follows: many programs for laser cutters read no text.
#pragma once

#include <vector>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// In the order of its letters; of the digits and of the letters A, c, r and s alone, which numbers
/// on a kit have.
std::vector<DrawnPath> strokes_of(const DrawnText& text);

}  // namespace misalign::schema
