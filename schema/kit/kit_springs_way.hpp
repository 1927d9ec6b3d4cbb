// Writes the section of a kit's guide that says how springs are hung: faces, heights, hooks and
// order.
#pragma once

#include <string>

#include "schema/kit/kit_bores.hpp"

namespace misalign::schema {

/// A heading, a sentence on clearance and a table with one row for each spring in the order of
/// hanging, as HTML; empty where the design has no springs, or the sheet does not deploy. Springs
/// without a diameter have kSpringDiameter_mm. `from_deg`: the angle of use.
std::string springs_way_section(const solver::Sheet& sheet, const Design& design,
                                const KitFittings& fittings, double from_deg);

}  // namespace misalign::schema
