// Judges fixed draws, by which builds and machines are compared.
#pragma once

#include <string>

#include "search/draws/parts.hpp"
#include "solver/lanes/batch.hpp"

namespace misalign::search {

/// Returns the fingerprint of this build's verdicts on fixed draws of a small sheet, with this
/// instruction set: the same for every build whose verdicts agree.
std::string golden_verdicts(solver::InstructionSet set);

/// Returns the mark by which builds and machines of this campaign are compared: their golden
/// verdicts and, if it optimises, the optima of fixed draws to the last bit.
std::string fingerprint(const schema::Campaign& campaign, const std::string& golden_verdicts,
                        const Parts& parts);

}  // namespace misalign::search
