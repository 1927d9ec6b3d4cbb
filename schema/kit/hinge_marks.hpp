// Draws the hinges of a plate: their axes, and the lines at which bevels begin.
#pragma once

#include "schema/kit/kit_item.hpp"
#include "schema/kit/panel_room.hpp"

namespace misalign::schema {

/// Adds axes from vertex to vertex (layer hinge), and where bevels begin: of valleys on the drawn
/// face (score_valley), of mountains on the other (score_mountain). Nothing without plates.
/// UserError (bad_request) if nothing is left of a face.
void add_hinges(const solver::Sheet& sheet, int facet, const KitFittings& fittings, KitItem& item);

/// Places the angles of bevels from square in degrees, "b51", each beside its line.
std::vector<DrawnText> bevel_angles(const solver::Sheet& sheet, int facet,
                                    const KitFittings& fittings, double height_mm, PanelRoom& room);

}  // namespace misalign::schema
