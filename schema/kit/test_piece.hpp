// Draws a test piece to cut before a kit: one hinge, one ball joint and one spring's tab, made like
// the kit's.
#pragma once

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/plate_edges.hpp"

namespace misalign::schema {

/// Two squares that a crease joins (two parts if creases are cut), the upper one cut clear of the
/// lower one's tab at the crease's left end; and a third to tie to the upper one's right corner:
/// with the crease, kerf, bores and edges of a kit. Squares of plates are set back from a valley's
/// axis, with its bevel, as the kit's plates are. Empty layers are left out.
LineDrawing kit_test_piece(const KitOptions& options, const PlateEdges& edges,
                           const std::string& title);

}  // namespace misalign::schema
