// A campaign as people write it and catalogues keep it, and its identity.
#pragma once

#include <optional>
#include <string>

#include "schema/campaign/campaign.hpp"
#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {

/// Reads and checks a campaign; UserError (bad_input) naming `source` with every fault. A FOLD file
/// that its pattern names is looked for in `directory`; without one none may be named.
Campaign read_campaign(const Json& value, const std::string& source,
                       const std::optional<std::filesystem::path>& directory = {});
Campaign read_campaign_file(const std::string& path);

/// The default campaign: the paper's.
Campaign default_campaign();

/// The resolved configuration, every key. Reading it again gives the same campaign.
Json campaign_json(const Campaign& campaign);

/// The same without what older programs do not know, where that is the default:
/// what a catalogue keeps, so that they can still read it.
Json stored_configuration(const Campaign& campaign);

/// What the identity is made of: pattern, misalignment, path, accept and seed, keys at their
/// defaults left out.
Json identity_json(const Campaign& campaign);

/// XXH3-128 of identity_json, sorted keys, no spaces: 32 hex digits.
std::string identity(const Campaign& campaign);

/// "/seed (1 there, 2 here)", for every key of the identity in which two campaigns differ.
std::string differences(const Campaign& there, const Campaign& here);

}  // namespace misalign::schema
