// Springs on the diagonals, as text.
#pragma once

#include <string>

#include "solver/motion/actuation.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::search {

/// The weakest point, the few springs that would do and the stroke; then energy and moment every 10
/// degrees and at D; then the force on each diagonal at D.
std::string actuators_text(const solver::Sheet& sheet, const solver::Actuation& actuation);

}  // namespace misalign::search
