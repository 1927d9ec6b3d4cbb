// The options of whoever lets sheets go: what drives them, what holds them back, what they weigh.
#pragma once

#include <CLI/CLI.hpp>

#include "search/checks/deployer.hpp"

namespace misalign::search {

/// --from, --stiffness, --thickness and --density: of everything that is made of plates.
void add_plates(CLI::App& verb, DeployWish& wish);

/// Those, joints, springs relaxed elsewhere, a held panel, and how the motion ends.
void add_deployment(CLI::App& verb, DeployWish& wish);

}  // namespace misalign::search
