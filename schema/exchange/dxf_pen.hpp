// Writes line drawings as DXF.
#pragma once

#include <string>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// AutoCAD 2000's DXF in mm ($INSUNITS, $MEASUREMENT), the page's lower left corner at 0, 0: layers
/// with names in capitals, hidden ones off; closed LWPOLYLINE, LINE, CIRCLE and TEXT. UserError
/// (failure) if it cannot be made.
std::string dxf_of(const LineDrawing& drawing);

}  // namespace misalign::schema
