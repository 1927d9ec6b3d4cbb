// Writes words as lines to engrave: many programs for laser cutters read no text.
#pragma once

#include <vector>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// Strokes in the order of the letters, round the middle of the base line. It has only digits and
/// the letters A, b, c, r and s, of which labels on a kit consist.
std::vector<DrawnPath> strokes_of(const DrawnText& text);

}  // namespace misalign::schema
