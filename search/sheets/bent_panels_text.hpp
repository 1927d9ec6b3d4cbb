// The study of panels that bend, in words.
#pragma once

#include <string>

#include "schema/pattern/material.hpp"
#include "solver/design/preload.hpp"

namespace misalign::search {

/// `rigid`: the same sheet with rigid panels, an upper bound.
std::string bent_panels_text(const schema::Material& material, const solver::BentPanels& study,
                             const solver::BentAdvice& advice,
                             const std::optional<solver::PreloadStudy>& preload,
                             const solver::FrictionLimits& rigid);

}  // namespace misalign::search
