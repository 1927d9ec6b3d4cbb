// The ascent of an accepted draw of an optimising search, or of a sheet of a population.
#pragma once

#include "search/draws/ascents.hpp"
#include "solver/optimise/optimise.hpp"

namespace misalign::search {

/// The campaign's options of ascents: its optimisation and misalignment, all in its identity.
solver::OptimiseOptions asked_of_ends(const schema::Campaign& campaign);

/// The ascent from an accepted draw, or from a sheet of a population.
std::unique_ptr<DrawAscent> optimised_draw(const schema::Campaign& campaign,
                                           const solver::Model& model, schema::Candidate start);

}  // namespace misalign::search
