// Writes line drawings as DXF.
#pragma once

#include <string>

#include "schema/exchange/line_drawing.hpp"

namespace misalign::schema {

/// DXF of AutoCAD 2000 in mm ($INSUNITS, $MEASUREMENT), the page's lower left corner at 0, 0:
/// layers with names in capitals, hidden ones off; closed LWPOLYLINE, LINE, CIRCLE and TEXT.
/// UserError (failure) if dxflib fails.
std::string dxf_of(const LineDrawing& drawing);

}  // namespace misalign::schema
