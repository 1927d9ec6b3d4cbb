// A study of backlash, as JSON.
#pragma once

#include <optional>

#include "schema/campaign/share_interval.hpp"
#include "schema/files/input.hpp"
#include "solver/play/backlash.hpp"

namespace misalign::schema {

/// The trials that move one way from `from_deg` up to this angle.
ShareOfTrials one_way_share(const solver::Backlash& backlash, double up_to_deg);

/// Without the sheet's name; the campaign's threshold, if it has one.
Json backlash_json(const solver::Backlash& backlash, std::optional<double> threshold_deg);

}  // namespace misalign::schema
