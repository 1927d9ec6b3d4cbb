// An accepted draw of an optimising search, or a sheet that a population found, made better.
#pragma once

#include "search/draws/ascents.hpp"
#include "solver/optimise/optimise.hpp"

namespace misalign::search {

/// What the campaign asks of sheets that are made better: of the optimisation and the misalignment,
/// all in its identity.
solver::OptimiseOptions asked_of_ends(const schema::Campaign& campaign);

/// An accepted draw, or a sheet that a population found, on its way to its end.
std::unique_ptr<DrawAscent> optimised_draw(const schema::Campaign& campaign,
                                           const solver::Model& model, schema::Candidate start);

}  // namespace misalign::search
