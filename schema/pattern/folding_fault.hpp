// Explains why a crease pattern does not fold, in a sentence that names the vertex and the crease.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/pattern/base_folding.hpp"

namespace misalign::schema {

/// Adds the fault of a sheet with these mountains and valleys (per edge: +1 valley, -1 mountain, 0
/// not given) to `faults`; `place` is the mesh's name in a sentence, empty for the document itself.
void add_folding_fault(const std::string& place, const solver::CreasePattern& sheet,
                       const std::vector<int>& assignment, const solver::NoBaseFolding& none,
                       InputFaults& faults);

}  // namespace misalign::schema
