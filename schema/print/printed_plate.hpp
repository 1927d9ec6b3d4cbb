// Makes a panel of a kit as a closed solid to print: plate, bores, tabs, and what its hinges need.
//
// A plate is a stack of levels. The levels of a bevelled plate are its lower face, the contour in
// the mid-plane and its upper face; a plate with films has levels set back between the walls of its
// slots; knuckles as thick as the plate end in chords of a circle round the axis, and have a bore
// for the pin. All levels of a plate have as many points, and neighbouring points are joined.
#pragma once

#include "schema/kit/kit_options.hpp"
#include "schema/kit/plate_ring.hpp"
#include "schema/print/solid.hpp"

namespace misalign::schema {

/// The plate of a panel, named "r1c2", where it lies in the flat sheet; its mid-plane is at z = 0.
/// `options` have plates with film, bevel or pin hinges. UserError (bad_request) if slots, knuckles
/// or bores of pins have no room.
Solid printed_plate(const solver::Sheet& sheet, int facet, const KitFittings& fittings,
                    const KitOptions& options);

/// The largest part of a plate's thickness that a slot may take.
inline constexpr double kMostSlot = 0.5;
/// The least wall round a pin.
inline constexpr double kPinWall_mm = 0.6;

}  // namespace misalign::schema
