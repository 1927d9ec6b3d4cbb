// Writes the study of panels that bend as JSON.
#pragma once

#include "schema/files/input.hpp"
#include "schema/pattern/material.hpp"
#include "solver/bending/bent_advice.hpp"
#include "solver/bending/buckling.hpp"
#include "solver/bending/preload.hpp"

namespace misalign::schema {

/// A sheet whose panels bend, with a study of its preload, if it has one.
struct BentSheet {
  Material material;
  solver::BentPanels panels;
  solver::BentAdvice advice;
  solver::BucklingStudy buckling;
  std::optional<solver::PreloadStudy> preload;
};

Json bent_panels_json(const BentSheet& sheet);

}  // namespace misalign::schema
