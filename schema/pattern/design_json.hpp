// Reads and writes the `design` block of campaign and pattern files.
#pragma once

#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/design.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::schema {

/// Reads "design" at `where`; wrong values are faults.
Design read_design(const Json& value, const std::string& where, InputFaults& faults);

/// Reads "actuators" of older files: stiffness, stroke limit, preload and largest force of
/// springs.
Design read_springs(const Json& value, const std::string& where, InputFaults& faults);

/// Returns every key; null for absent values without a default. Springs are written as "springs",
/// also those that were read from "fill"; other fillings as "fill".
Json design_json(const Design& design);
/// Returns the design as JSON without defaults.
Json explicit_design_json(const Design& design);

/// Checks that a design names diagonals and panels of its sheet. UserError (bad_input) about
/// `source`: a preload of no diagonal, or a held panel that does not exist.
void check_names(const Design& design, const solver::PerforatedSheet& base,
                 const std::string& source);

}  // namespace misalign::schema
