// Finds the play of a sheet's joints by its design.
#pragma once

#include <optional>
#include <vector>

#include "schema/campaign/campaign.hpp"
#include "schema/pattern/design.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::search {

/// The design's play, otherwise that of its ball joints up to the angle of use; none without
/// either. UserError (bad_request) if their wire is thicker than their bores.
std::optional<double> play_of(const schema::Design& design, const solver::Sheet& sheet);

/// The play of the first of some sheets of a campaign, likewise.
std::optional<double> play_of(const schema::Design& design, const schema::Campaign& campaign,
                              const std::vector<Eigen::Matrix2Xd>& shifts_mm);

}  // namespace misalign::search
