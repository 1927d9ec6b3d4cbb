// Lists the libraries of this build, and refuses what needs another.
#pragma once

#include <string>

#include "generated/features.hpp"

namespace misalign::schema {

/// "a MAT-file needs matio (this program was built without it); install ..."
std::string missing_text(std::string_view library);

/// Throws a UserError (failure) with that sentence if this build lacks the library.
void need(std::string_view library);

/// Returns the libraries of this build, or the missing ones: "FLINT, matio"; "none".
std::string libraries_text(bool in);

}  // namespace misalign::schema
