// The objective of an optimisation, of sheets that keep what is asked.
#pragma once

#include <optional>

#include "solver/optimise/optimise_options.hpp"

namespace misalign::solver {

/// `options.deploying` says from where it is let go.
bool is_strong_enough(const Sheet& sheet, const OptimiseOptions& options);
/// Whether it deploys from the angle that is asked, can be let go there, and keeps stroke and
/// force.
bool fits(const Sheet& sheet, const OptimiseOptions& options);
/// Whether, up to the angle that is asked, no diagonal turns back between samples and no crease is
/// all but folded flat: what a certificate wants, and a draw need not have.
bool goes_all_the_way(const Sheet& sheet, const OptimiseOptions& options);
/// Whether free shifts leave every diagonal its least slope at every angle, where that is asked, or
/// no less than the sheet had before.
bool keeps_slope(const Sheet& sheet, const Sheet& before, const OptimiseOptions& options);
/// The value of the goal, of a sheet that is to be better than another; none where it does not fit,
/// violates a floor, does not go all the way, or has no value.
std::optional<double> objective(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
