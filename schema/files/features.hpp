// Says which libraries this build has, and refuses what needs another.
#pragma once

#include <string>

#include "generated/features.hpp"

namespace misalign::schema {

/// "a MAT-file needs matio (this program was built without it); install ..."
std::string missing_text(std::string_view library);

/// UserError (failure) with that sentence where this build is without the library.
void need(std::string_view library);

/// Those that are in, or those that are not: "FLINT, matio"; "none".
std::string libraries_text(bool in);

}  // namespace misalign::schema
