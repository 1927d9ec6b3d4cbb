// The options of verbs that deploy sheets: springs, resistance of joints, mass, end of the motion.
#pragma once

#include <CLI/CLI.hpp>

#include "search/sheets/deploy_input.hpp"

namespace misalign::search {

/// Adds --from, springs, plates, joints, a held panel, and the motion's end.
void add_deployment(CLI::App& verb, DeployInput& input);

}  // namespace misalign::search
