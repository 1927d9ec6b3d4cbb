// Fixed draws, by which builds and machines know each other.
#pragma once

#include <string>

#include "search/draws/parts.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Fingerprint of this build's verdicts on fixed draws of a small sheet, in these registers: whole
/// numbers, the same for every build whose verdicts can be trusted to agree.
std::string golden_verdicts(solver::InstructionSet set);

/// The mark by which builds and machines that work on this campaign know each other: their
/// verdicts, and where it optimises also the sheets at which fixed draws end, to the last bit.
std::string fingerprint(const schema::Campaign& campaign, const std::string& golden_verdicts,
                        const Parts& parts);

}  // namespace misalign::search
