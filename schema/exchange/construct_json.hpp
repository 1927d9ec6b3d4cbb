// Writes a constructed sheet as JSON: its pattern, its holes, and its proof.
#pragma once

#include "schema/pattern/pattern_file.hpp"
#include "solver/optimise/construct.hpp"

namespace misalign::schema {

Json construct_json(const Pattern& base, const solver::ConstructStudy& study, double at_deg);

}  // namespace misalign::schema
