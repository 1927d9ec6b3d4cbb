// The lines of a card about copies of its sheet: miscut ones, and ones with loose joints.
#pragma once

#include <cstdint>
#include <vector>

#include "search/sheets/card_lines.hpp"

namespace misalign::search {

/// Copies that are tried, and the threads that do.
struct CopyTrials {
  std::uint64_t trials;
  int jobs;
};

/// Yield at the design's cutting error, and the largest clearance of its joints: only what the
/// design names.
std::vector<schema::CardLine> copy_lines(const CardSheet& on, const CopyTrials& copies);

}  // namespace misalign::search
