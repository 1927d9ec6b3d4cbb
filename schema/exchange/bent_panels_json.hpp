// The study of panels that bend, as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "schema/pattern/material.hpp"
#include "solver/design/preload.hpp"

namespace misalign::schema {

/// `preload`: where springs have one.
Json bent_panels_json(const Material& material, const solver::BentPanels& study,
                      const solver::BentAdvice& advice,
                      const std::optional<solver::PreloadStudy>& preload);

}  // namespace misalign::schema
