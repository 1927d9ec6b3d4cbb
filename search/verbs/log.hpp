// Messages on standard error: "misalign: ...".
#pragma once

#include <string>

#include "search/terminal/terminal.hpp"

namespace misalign::search {

/// From now on spdlog's functions write them; `level`: the least important ones that are shown.
void set_up_log(const std::string& level, ColorMode color);

}  // namespace misalign::search
