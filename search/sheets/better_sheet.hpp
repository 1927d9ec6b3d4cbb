// A better sheet near a chosen one, proven.
#pragma once

#include <functional>

#include "schema/campaign/optimisation.hpp"
#include "schema/exchange/optimise_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// What is asked of a better sheet, as people type it: shifts of its start are rounded to a grid.
struct OptimiseInput : schema::OptimiseRequest {
  std::optional<double> amplitude_mm;      ///< none: the campaign's, or the largest of its shifts
  std::optional<double> deploys_from_deg;  ///< none: the campaign's, or its own D
  bool within_family = false;              ///< only among members of the base's parallel family
  /// The least and the most of what springs may have; empty: what the design says.
  std::vector<double> stiffness_n_per_mm = {}, preload_n = {};
  std::optional<double> rest_deg = {};  ///< where the springs are relaxed; none: flat
  double miscut_mm = 0.05;              ///< of copies, where their yield is asked
  std::uint64_t trials = 200;           ///< so many of them
  int jobs = 1;                         ///< threads that judge copies
  std::function<void()> watch = [] {};  ///< called in between; what it throws ends the search
};

/// The options that say so; what is asked of one sheet, or of draws alone, is added to them.
solver::OptimiseOptions options_of(const schema::OptimiseRequest& request);

/// What was found, and the angle up to which that sheet is proven; none of springs off the
/// mid-plane.
struct ProvenBetter {
  solver::Optimised found;
  std::optional<double> certified_deg;
};

/// From the subject's sheet, with its design: springs, stroke limit, hinges, panels, angle of use.
/// Steps at the end of which nothing is proven up to the angle asked for are taken back. UserError:
/// 2 where an option does not fit it, 1 where its path is lost.
ProvenBetter optimised(const Subject& subject, const OptimiseInput& input);

/// The sheet that was found as a pattern file, with the subject's sampling and design.
schema::Json better_pattern(const Subject& subject, const ProvenBetter& better);

}  // namespace misalign::search
