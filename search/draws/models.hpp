// Builds the model of a campaign or a pattern, which folds its sheets.
#pragma once

#include "schema/campaign/campaign.hpp"
#include "solver/model/model.hpp"

namespace misalign::search {

/// Stations of a path besides its samples: multiples of `step_deg` (0: none) and the angles
/// `at_deg`, up to the path's end.
struct StationOptions {
  StationOptions(double step = 0, std::vector<double> at = {})
      : step_deg(step), at_deg(std::move(at)) {}
  double step_deg;
  std::vector<double> at_deg;
};

/// Returns a campaign's model, whose draws shift the misalignment's vertices.
solver::Model model_of(const schema::Campaign& campaign, const StationOptions& stations = {});

/// Returns a campaign's model with scores, for draws that may deploy from `sample` on.
solver::Model scoring_model_of(const schema::Campaign& campaign, int sample);

/// Returns a pattern's model, which has no threshold.
solver::Model model_of(const schema::Pattern& pattern, const schema::Sampling& sampling,
                       const StationOptions& stations = {});

}  // namespace misalign::search
