// Reads the target of a search among sheets of one shape, and checks such a campaign.
#pragma once

#include <filesystem>

#include "schema/campaign/campaign.hpp"

namespace misalign::schema {

/// Reads "target" of a campaign whose pattern and search method are known; its base has no panels
/// if it has faults. A file that it names is relative to `directory`.
void read_campaign_target(ObjectReader& reader, const std::filesystem::path& directory,
                          Campaign& campaign);

/// Adds a fault for each key that a search among sheets of one shape lacks or excludes.
void check_shape_search(const Campaign& campaign, InputFaults& faults);

}  // namespace misalign::schema
