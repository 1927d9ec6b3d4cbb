// Reads a file that holds a pattern, in any known format.
#pragma once

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Returns the document of a JSON file, FOLD included, or an OBJ file as a FOLD object. UserError
/// (bad_input) names the formats if it is none of them; else as read_json_file.
Json read_pattern_document(const std::string& path, FileKind kind = FileKind::any);

}  // namespace misalign::schema
