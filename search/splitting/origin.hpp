// Numbers the sheets that a population has met by where they were met.
#pragma once

#include "schema/campaign/splitting.hpp"
#include "search/splitting/population.hpp"

namespace misalign::search {

/// Returns a sheet's number. Population r has the numbers from r * kNumbersOfPopulation up: first
/// the first draws in turn, then for each level the moves of its first step in turn, of its second,
/// and so forth. So numbers ascend with (population, level, step, particle).
std::uint64_t number_of(const Origin& origin, const schema::Splitting& splitting);
Origin origin_of(std::uint64_t number, const schema::Splitting& splitting);

}  // namespace misalign::search
