// Tells the fillings for which a certificate can prove that the energy rises from flat.
#pragma once

#include "solver/fill/fill.hpp"

namespace misalign::solver {

/// Returns why no certificate proves that the energy of such a filling rises from flat; null where
/// one can.
const char* why_not_certifiable(const Fill& fill, const SpringEnds& ends);

}  // namespace misalign::solver
