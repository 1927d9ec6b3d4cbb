// A sheet that was made better, as text.
#pragma once

#include <string>

#include "search/sheets/better_sheet.hpp"

namespace misalign::search {

/// `sheet`: the one that was found.
std::string optimise_text(const Subject& subject, const solver::Sheet& sheet,
                          const ProvenBetter& better);

}  // namespace misalign::search
