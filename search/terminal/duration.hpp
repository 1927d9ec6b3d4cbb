// Writes durations for people.
#pragma once

#include <string>

namespace misalign::search {

/// 45 s, 2 min 30 s, 12 h 10 min, 3 d 4 h, 12 years; "ages" beyond counting.
std::string duration(double seconds);

}  // namespace misalign::search
