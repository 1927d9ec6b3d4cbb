// Writes the guide of a kit: what to buy, its sheets of material, its assembly row by row, and its
// numbers.
#pragma once

#include "schema/kit/guide_input.hpp"

namespace misalign::schema {

/// A self-contained page to print on A4, as HTML. Lengths in the kit's unit, forces in N.
std::string kit_guide(const GuideInput& input);

}  // namespace misalign::schema
