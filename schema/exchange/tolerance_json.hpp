// Writes a study of tolerance as JSON.
#pragma once

#include "schema/campaign/share_interval.hpp"
#include "schema/files/input.hpp"
#include "solver/play/miscut_gap.hpp"
#include "solver/play/tolerance.hpp"

namespace misalign::schema {

inline ShareOfTrials share_of(std::uint64_t hits, const solver::MiscutCopies& copies) {
  return share_of(hits, copies.undecided, copies.trials);
}

/// The study without the sheet's name.
Json tolerance_json(const solver::Tolerance& tolerance);

/// {"amplitude_mm", "trials", "open": [{"pilot_deg", "median_mm", "of_95_percent_mm",
/// "largest_mm"}]}.
Json miscut_gap_json(const solver::MiscutGap& gap);

}  // namespace misalign::schema
