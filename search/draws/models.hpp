// The model of a campaign or a pattern: built once, and passed on to whoever folds its sheets.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

/// Where a path is looked at besides its samples: at multiples of `step_deg` (0: at none), and at
/// the angles of `at_deg`, as far as the path is followed.
struct StationOptions {
  StationOptions(double step = 0, std::vector<double> at = {})
      : step_deg(step), at_deg(std::move(at)) {}
  double step_deg;
  std::vector<double> at_deg;
};

/// A campaign's: its draws shift its misalignment's vertices.
solver::Model model_of(const schema::Campaign& campaign, const StationOptions& stations = {});

/// The same for those of its draws that may deploy from `sample` on, with scores.
solver::Model scoring_model_of(const schema::Campaign& campaign, int sample);

/// A pattern's, which has no threshold.
solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       const StationOptions& stations = {});

}  // namespace misalign::search
