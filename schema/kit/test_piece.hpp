// What to cut before a kit: one hinge and one ball joint, made as the kit's are.
#pragma once

#include "schema/exchange/line_drawing.hpp"
#include "schema/kit/kit_options.hpp"

namespace misalign::schema {

/// Two squares that a crease joins (two parts where creases are cut), and a third to be tied to a
/// corner of them: with the crease, kerf, bores and edges of a kit. Layers without a line are left
/// out.
LineDrawing kit_test_piece(const KitOptions& options, const std::string& title);

}  // namespace misalign::schema
