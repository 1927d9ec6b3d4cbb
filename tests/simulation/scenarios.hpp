// Scenarios that stories have found: each failed with the program before it was mended.
#pragma once

#include "tests/simulation/disk.hpp"

namespace misalign::simulation {

/// Plays all scenarios; prints what goes wrong, and returns whether nothing does.
bool play_scenarios(Disk& disk);

}  // namespace misalign::simulation
