// Describes the ball joints of a kit: parts, places, play.
#pragma once

#include <string>

#include "schema/kit/kit_options.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// A sentence on the kind of ball joints and their play, for drawings; empty without a kind.
std::string joint_words(const solver::Sheet& sheet, const KitOptions& options);

/// A section of a guide, as HTML: what each joint is made of, how it is tied, and its play; empty
/// without a kind.
std::string joint_section(const solver::Sheet& sheet, const KitOptions& options);

}  // namespace misalign::schema
