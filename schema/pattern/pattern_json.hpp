// Patterns as objects of JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/pattern.hpp"
#include "schema/pattern/perforation_check.hpp"

namespace misalign::schema {

/// Reads and checks a pattern object at `where`. Only when it added no fault is the result usable.
/// A FOLD file that it names is looked for in `directory`; what a catalogue or an exported
/// candidate holds comes without one, and may name none: its mesh is with it.
Pattern read_pattern(const Json& value, const std::string& where, Displacements displacements,
                     const std::optional<std::filesystem::path>& directory, InputFaults& faults,
                     Perforations perforations = Perforations::of_one_freedom);

/// The base with these shifts, in the contract's names; displacements only where there are some.
/// Reading it again gives the same pattern.
Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm);

/// {"A10": [0.4, 0.0], ...}: the vertices that are shifted, exactly.
Json displacements_json(const Eigen::Matrix2Xd& shifts_mm);

}  // namespace misalign::schema
