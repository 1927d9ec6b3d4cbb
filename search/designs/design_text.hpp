// The designs that were tried, in words.
#pragma once

#include <string>
#include <vector>

#include "search/designs/design_try.hpp"

namespace misalign::search {

/// A table of the tries, the best first: sheet, chosen numbers, least reserve or what it lacks.
std::string designs_text(const std::string& wish, const std::vector<DesignTry>& tries);

}  // namespace misalign::search
