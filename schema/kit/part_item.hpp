// Draws a part: its cuts, scores, bores and engraved labels.
#pragma once

#include <vector>

#include "schema/kit/kit_bores.hpp"
#include "schema/kit/kit_item.hpp"
#include "schema/kit/kit_outline.hpp"

namespace misalign::schema {

/// A part in the sheet's coordinates.
KitItem part_item(const solver::Sheet& sheet, const KitPart& part, const KitFittings& fittings,
                  const KitOptions& options);

/// The cuts of a perforation between two points: as many dashes, shortened by the kerf, as have
/// room between bridges of at least the requested length. It begins and ends with a bridge; all
/// bridges are equal.
std::vector<DrawnPath> perforation(const Eigen::Vector2d& from_mm, const Eigen::Vector2d& to_mm,
                                   const KitOptions& options);

}  // namespace misalign::schema
