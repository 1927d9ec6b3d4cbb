// Optimises a chosen sheet, and proves the optimum.
#pragma once

#include <functional>

#include "schema/campaign/optimisation.hpp"
#include "schema/exchange/optimise_json.hpp"
#include "search/sheets/chosen_sheet.hpp"

namespace misalign::search {

/// The request for a better sheet, as typed: shifts of its start are rounded to a grid.
struct OptimiseInput : schema::OptimiseRequest {
  std::optional<double> amplitude_mm;  ///< none: the campaign's, or the largest of its shifts
  std::optional<double>
      deploys_from_deg;        ///< none: the design's angle of use, the campaign's, or D
  bool with_rim = false;       ///< vertices of the rim are shifted, too
  bool tries_flips = true;     ///< solver::OptimiseOptions has it
  bool within_family = false;  ///< only among members of the base's parallel family
  /// Bounds of the springs' rate and preload; empty: the design's values.
  std::vector<double> stiffness_n_per_mm = {}, preload_n = {};
  std::optional<double> rest_deg = {};   ///< pilot angle of relaxed springs; none: the design's
  std::optional<double> miscut_mm = {};  ///< cutting error of copies; none: the design's, or 0.05
  std::uint64_t trials = 200;            ///< copies
  int jobs = 1;                          ///< threads that judge copies
  std::function<void()> watch = [] {};   ///< called in between; what it throws ends the search
};

/// Options of the request; those of one sheet, or of draws alone, are added to them.
solver::OptimiseOptions options_of(const schema::OptimiseRequest& request);

/// The optimum, and the angle up to which it is proven; none for springs off the mid-plane.
struct ProvenBetter {
  solver::Optimised found;
  std::optional<double> certified_deg;
};

/// Ascends from the subject's sheet with its design: springs, stroke limit, hinges, panels, angle
/// of use. Last steps that are not proven up to the requested angle are taken back. UserError: 2
/// where an option does not fit it, 1 where its path is lost.
ProvenBetter optimised(const Subject& subject, const OptimiseInput& input);

/// The optimum as a pattern file, with the subject's sampling and design.
schema::Json better_pattern(const Subject& subject, const ProvenBetter& better);

}  // namespace misalign::search
