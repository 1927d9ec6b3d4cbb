// Lets springs share the lengths of their links.
#pragma once

#include <vector>

#include "solver/fitting/stock_drive.hpp"

namespace misalign::solver {

/// Returns the same springs with as few lengths of links as overcome the demand, of those that
/// `picks` have, and then each length as weak as it permits: a step longer of springs that pull, or
/// shorter of those that push, would not. `picks` have the lengths with which springs are
/// strongest. After many sets of lengths the search for fewer ends.
std::vector<StockPick> with_few_links(const StockDrive& drive, const std::vector<StockPick>& picks);

}  // namespace misalign::solver
