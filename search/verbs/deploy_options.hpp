// The options of verbs that deploy sheets: what drives them, what holds them back, what they weigh.
#pragma once

#include <CLI/CLI.hpp>

#include "search/sheets/deploy_input.hpp"

namespace misalign::search {

/// --from, springs, plates and joints, a held panel, and how the motion ends.
void add_deployment(CLI::App& verb, DeployInput& input);

}  // namespace misalign::search
