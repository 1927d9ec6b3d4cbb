// What a sheet is worth to an optimisation, where it keeps what is asked.
#pragma once

#include <optional>

#include "solver/optimise/optimise_options.hpp"

namespace misalign::solver {

/// `options.deploying` says from where it is let go.
bool is_strong_enough(const Sheet& sheet, const OptimiseOptions& options);
/// Up to where every diagonal goes one way, between samples too, and it goes on folding.
double goes_until_deg(const Sheet& sheet);
/// What a sheet that can be let go is worth by a goal; none where its study finds nothing.
std::optional<double> value_by(OptimiseGoal goal, const Sheet& sheet,
                               const OptimiseOptions& options);
/// Whether its values by the floors' goals are no lower.
bool keeps_floors(const Sheet& sheet, const OptimiseOptions& options);
/// Whether it deploys from the angle that is asked, can be let go there, and keeps stroke and
/// force.
bool fits(const Sheet& sheet, const OptimiseOptions& options);
/// Whether, up to the angle that is asked, no diagonal turns back between samples and no crease is
/// all but folded flat: what a certificate wants, and a draw need not have.
bool goes_all_the_way(const Sheet& sheet, const OptimiseOptions& options);
/// Whether free shifts leave every diagonal its least slope at every angle, where that is asked, or
/// no less than the sheet had before.
bool keeps_slope(const Sheet& sheet, const Sheet& before, const OptimiseOptions& options);
/// By the goal, of a sheet that is to be better than another; none where it does not fit, keeps not
/// all floors, does not go all the way, or its own study finds none.
std::optional<double> worth(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
