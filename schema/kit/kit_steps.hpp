// Writes the assembly of a kit, a step for each row of panels.
#pragma once

#include <string>

#include "schema/kit/guide_input.hpp"

namespace misalign::schema {

/// Steps: the test piece, rows of panels, ball joints in order, folding by hand, springs, stop or
/// latch, release.
std::string kit_steps(const GuideInput& input);

}  // namespace misalign::schema
