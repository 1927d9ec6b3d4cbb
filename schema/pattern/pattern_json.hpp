// Reads and writes patterns as objects of JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/pattern.hpp"
#include "schema/pattern/perforation_check.hpp"

namespace misalign::schema {

/// Reads and checks a pattern object at `where`; usable only without faults. A FOLD file that it
/// names is relative to `directory`. A catalogue or an exported candidate has no directory, and may
/// name no file: it holds its mesh.
Pattern read_pattern(const Json& value, const std::string& where, Displacements displacements,
                     const std::optional<std::filesystem::path>& directory, InputFaults& faults,
                     Perforations perforations = Perforations::of_one_freedom);

/// Returns the base with these shifts; displacements only if there are any. Reading it again gives
/// the same pattern.
Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm);

/// Returns {"A10": [0.4, 0.0], ...}: the shifted vertices, exactly.
Json displacements_json(const Eigen::Matrix2Xd& shifts_mm);

}  // namespace misalign::schema
