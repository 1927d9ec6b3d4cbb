// Reads and writes the `design` block of campaign and pattern files.
#pragma once

#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/design.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::schema {

/// Reads "design" at `where`; what is wrong is a fault.
Design read_design(const Json& value, const std::string& where, InputFaults& faults);

/// The same of "springs" alone, which older files call "actuators".
Design read_springs(const Json& value, const std::string& where, InputFaults& faults);

/// Every key; null what is not said and has no number that holds instead.
Json design_json(const Design& design);
/// The design as JSON without the parts that are as by default.
Json explicit_design_json(const Design& design);

/// Checks that a design names diagonals and panels of its sheet. UserError (bad_input) about
/// `source`: a preload of no diagonal, a hold that is no panel.
void check_names(const Design& design, const solver::PerforatedSheet& base,
                 const std::string& source);

}  // namespace misalign::schema
