// Writes line drawings as SVG.
#pragma once

#include <string>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// One user unit a mm; a group with Inkscape's names for each layer, hidden ones not displayed.
std::string svg_of(const LineDrawing& drawing);

}  // namespace misalign::schema
