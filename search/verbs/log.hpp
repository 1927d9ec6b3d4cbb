// Messages on standard error: "misalign: ...".
#pragma once

#include <string>

#include "search/terminal/terminal.hpp"

namespace misalign::search {

/// Makes spdlog write messages so; `level`: the lowest level that is shown.
void set_up_log(const std::string& level, ColorMode color);

}  // namespace misalign::search
