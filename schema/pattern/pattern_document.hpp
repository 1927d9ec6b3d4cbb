// Reads a file that holds a pattern, in whichever of the formats that are known.
#pragma once

#include <string>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// What a file of JSON holds, FOLD being that, too, or an OBJ file as a FOLD object. UserError
/// (bad_input) names the formats where it is none of them, and whatever read_json_file does.
Json read_pattern_document(const std::string& path, FileKind kind = FileKind::any);

}  // namespace misalign::schema
