// The lines of a card about the drive: margins over friction, bent panels, landing, pins.
#pragma once

#include <vector>

#include "search/sheets/card_lines.hpp"
#include "search/sheets/studies.hpp"
#include "solver/motion/deploy.hpp"

namespace misalign::search {

/// Margins over the friction of hinges and pins, stress and buckling of panels, modes at flat, and
/// the landing of the sheet, released at its angle of use.
std::vector<schema::CardLine> drive_lines(const CardSheet& on, Advice advice);

/// The sheet's release at its angle of use, or where its way ends before.
solver::ReleaseOptions release_of(const CardSheet& on);

}  // namespace misalign::search
