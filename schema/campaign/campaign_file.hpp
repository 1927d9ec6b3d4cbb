// Reads and writes campaigns, as files and in catalogues, and computes their identity.
#pragma once

#include <optional>
#include <string>

#include "schema/campaign/campaign.hpp"
#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {

/// Reads and checks a campaign; UserError (bad_input) naming `source` lists every fault. A FOLD
/// file of its pattern is relative to `directory`; without one no file may be named.
Campaign read_campaign(const Json& value, const std::string& source,
                       const std::optional<std::filesystem::path>& directory = {});
Campaign read_campaign_file(const std::string& path);

/// Returns the default campaign, the paper's.
Campaign default_campaign();

/// Returns the resolved configuration with every key. Reading it again gives the same campaign.
Json campaign_json(const Campaign& campaign);

/// Returns the configuration for a catalogue: keys that older programs do not know are left out at
/// their defaults, so that these can still read it.
Json stored_configuration(const Campaign& campaign);

/// Returns the keys of the identity: pattern, misalignment, path, accept and seed, without keys at
/// their defaults.
Json identity_json(const Campaign& campaign);

/// Returns the identity: XXH3-128 of identity_json, sorted keys, no spaces; 32 hex digits.
std::string identity(const Campaign& campaign);

/// Returns "/seed (1 there, 2 here)" for every key of the identity in which two campaigns differ.
std::string differences(const Campaign& held, const Campaign& wanted);

}  // namespace misalign::schema
