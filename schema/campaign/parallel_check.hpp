// Checks a campaign whose draws are members of a parallel family.
#pragma once

#include "schema/campaign/campaign.hpp"

namespace misalign::schema {

/// Returns whether all creases of the sheets reach 180 degrees at once on followed paths, where
/// rounding would decide; with fewer holes paths are known in closed form.
bool closes_at_180(const Campaign& campaign);

/// Adds a fault for each key that draws of the parallel family exclude.
void check_parallel(const Campaign& campaign, InputFaults& faults);

}  // namespace misalign::schema
