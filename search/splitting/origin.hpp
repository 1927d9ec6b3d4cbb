// The number of a sheet that a population has met, and where it was met.
#pragma once

#include "schema/campaign/splitting.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// Population r has the numbers from r * kNumbersOfPopulation on: the first draws in turn, then for
/// each level the moves of its first step in turn, of its second, and so forth. So the least number
/// is the least (population, level, step, particle).
std::uint64_t number_of(const Origin& origin, const schema::Splitting& splitting);
Origin origin_of(std::uint64_t number, const schema::Splitting& splitting);

}  // namespace misalign::search
