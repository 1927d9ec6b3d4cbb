// Reads flat meshes from Wavefront's OBJ.
#pragma once

#include <string_view>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Whether a text begins as OBJ does, after blank lines and comments.
bool is_obj(std::string_view text);

/// Its vertices, faces and lines as a FOLD object. OBJ knows no mountains and valleys: a line (`l`)
/// is one in a group, object or material whose name begins with "mountain" or "valley"; every other
/// edge is unassigned, "U". An entry that is no number stays a text, which the reader of FOLD
/// refuses.
Json obj_as_fold(std::string_view text);

}  // namespace misalign::schema
