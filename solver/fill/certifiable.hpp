// Tells the fillings for which a certificate can prove that the energy rises from flat, or its
// wells.
#pragma once

#include "solver/fill/fill.hpp"

namespace misalign::solver {

/// Returns why no certificate proves that the energy of such a filling rises from flat; null where
/// one can.
const char* why_not_certifiable(const Fill& fill, const SpringEnds& ends);

/// Returns why no proof shows how many wells the energy of such a filling has; null where one can.
/// Springs may be relaxed at any angle.
const char* why_no_wells(const Fill& fill, const SpringEnds& ends);

}  // namespace misalign::solver
