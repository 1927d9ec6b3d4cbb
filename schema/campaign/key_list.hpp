// Writes the keys of a campaign as a Markdown table, from campaign.schema.json.
#pragma once

#include <string>

namespace misalign::schema {

/// Returns a Markdown table: a row for each key, with its type, default, bounds and meaning.
std::string campaign_keys_markdown();

}  // namespace misalign::schema
