// Describes the ball joints of a kit: parts, places, play.
#pragma once

#include <string>

#include "schema/kit/kit_options.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// "loops of wire of 1 mm in bores of 1.2 mm".
std::string joint_words(const solver::JointParts& parts);
/// Sentences on the making of a joint.
const char* joint_steps(solver::JointKind kind);

/// A section of a guide, as HTML: what each joint is made of, how it is tied, and its play; empty
/// without a kind.
std::string joint_section(const solver::Sheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
