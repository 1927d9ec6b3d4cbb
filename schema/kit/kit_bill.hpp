// Writes what to buy for a kit.
#pragma once

#include <string>

#include "schema/kit/guide_input.hpp"

namespace misalign::schema {

/// A table: sheets of material, hinges, loops of wire, groups of equal springs or plates, and a
/// stop or latch; then how thick panels may be.
std::string kit_bill(const GuideInput& input);

}  // namespace misalign::schema
