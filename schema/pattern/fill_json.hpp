// Reads and writes the filling of a sheet's holes: springs, rubber plates or nothing.
#pragma once

#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/design.hpp"

namespace misalign::schema {

/// Reads "springs" or "fill" of a design; wrong values are faults, and both keys are.
void read_fill(ObjectReader& reader, Design& design);

/// Reads an object such as {"kind": "plate", "prestretch": 1.1} at `where`; wrong values are
/// faults. `find_fill_faults` checks that a sheet has what it names.
Design read_fill(const Json& value, const std::string& where, InputFaults& faults);

/// Reads the filling of a sheet, apart from limits that only studies judge; these, and names that
/// the sheet has not, are faults, and then there is none.
std::optional<solver::Fill> read_fill_of(const solver::PerforatedSheet& base, const Json& value,
                                         const std::string& where, InputFaults& faults);

/// Returns every key of the filling, its "kind" first.
Json fill_json(const Design& design);
Json fill_json(const solver::Fill& fill, const solver::PerforatedSheet& base);
/// Returns the keys of springs, without their kind; null for absent values without a default.
Json springs_json(const Design& design);

/// Adds "on" and "single" to an object about springs, unless these are on all diagonals, and equal.
void add_single_springs(const solver::Springs& springs, Json& json);

/// Adds a fault for each diagonal and hole that the sheet has not, or that is named twice.
void find_fill_faults(const DesignFill& design, const solver::PerforatedSheet& base,
                      const std::string& where, InputFaults& faults);
/// Throws a UserError if there is such a fault.
void check_fill(const DesignFill& design, const solver::PerforatedSheet& base);

}  // namespace misalign::schema
