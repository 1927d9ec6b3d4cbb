// Fixed draws, by which builds and machines know each other.
#pragma once

#include <string>

#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Fingerprint of this build's verdicts on fixed draws of a small sheet, in these registers: whole
/// numbers, the same for every build whose verdicts can be trusted to agree.
std::string golden_verdicts(solver::InstructionSet set);

}  // namespace misalign::search
