// An accepted draw of an optimising search, or a sheet that a population found, made better.
#pragma once

#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/climber.hpp"
#include "solver/optimise/optimise.hpp"

namespace misalign::search {

/// What the campaign asks of sheets that are made better: of the optimisation and the misalignment,
/// all in its identity.
solver::OptimiseOptions asked_of_ends(const schema::Campaign& campaign);

/// Accepted draws go to their ends, if the campaign optimises; or sheets that populations find.
void optimise_if_asked(DrawEvaluator& evaluator);
void optimise_if_asked(Climber& climber);

/// By what builds and machines know each other that work on this campaign: their golden_verdicts,
/// and where it optimises also the sheets at which fixed draws end, to the last bit.
std::string fingerprint(const schema::Campaign& campaign, const std::string& golden_verdicts);

}  // namespace misalign::search
