// Writes line drawings as SVG.
#pragma once

#include <string>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// SVG with 1 mm per user unit; a group with Inkscape's names for each layer, hidden ones not
/// displayed.
std::string svg_of(const LineDrawing& drawing);

}  // namespace misalign::schema
