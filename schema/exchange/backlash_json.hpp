// Writes a study of backlash as JSON.
#pragma once

#include <optional>

#include "schema/campaign/share_interval.hpp"
#include "schema/files/input.hpp"
#include "solver/play/backlash.hpp"

namespace misalign::schema {

/// The share of trials that move one way from `from_deg` up to `up_to_deg`.
ShareOfTrials one_way_share(const solver::Backlash& backlash, double up_to_deg);

/// The study without the sheet's name; with the campaign's threshold, if it has one.
Json backlash_json(const solver::Backlash& backlash, std::optional<double> threshold_deg);

}  // namespace misalign::schema
