// Shows the target of a sheet in the folding picture: the surface, and the panels' distances.
#pragma once

#include "schema/pattern/target.hpp"
#include "solver/target/shape_measure.hpp"

namespace misalign::schema {

/// The target beside the sheet where it has its shape: a grid of the surface's points (in base64,
/// relative to the middle of the flat sheet as detail_json's shapes are) and the largest distance
/// of each panel, mm. Null where the target is places, or the sheet's history has no row there.
Json target_shown_json(const solver::Sheet& sheet, const solver::ShapeMeasure& measure);

}  // namespace misalign::schema
