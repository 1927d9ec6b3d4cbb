// Reads flat meshes from Wavefront's OBJ.
#pragma once

#include <string_view>

#include "schema/files/input.hpp"

namespace misalign::schema {

/// Returns whether a text begins like OBJ, after blank lines and comments.
bool is_obj(std::string_view text);

/// Returns vertices, faces and lines as a FOLD object. OBJ has no mountains and valleys: a line
/// (`l`) is one in a group, object or material with a name that begins with "mountain" or "valley";
/// every other edge is unassigned, "U". An entry that is no number stays a text, which the FOLD
/// reader refuses.
Json obj_as_fold(std::string_view text);

}  // namespace misalign::schema
