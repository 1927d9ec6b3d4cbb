// The lines of a card about copies of its sheet: miscut ones, and ones with loose joints.
#pragma once

#include <cstdint>
#include <vector>

#include "schema/exchange/card_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// Copies that are tried, and the threads that do.
struct CopyTrials {
  std::uint64_t trials;
  int jobs;
};

/// Yield at the design's cutting error, and the largest clearance of its joints: only what the
/// design names. The sheet is used from `used_deg` on.
std::vector<schema::CardLine> copy_lines(const ChosenSheet& chosen, const solver::Sheet& sheet,
                                         const schema::Design& design, double used_deg,
                                         const CopyTrials& copies);

}  // namespace misalign::search
