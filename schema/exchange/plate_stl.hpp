// Writes panels as plates in a folded state, for printers and solid modellers.
#pragma once

#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/contact/plate_solid.hpp"

namespace misalign::schema {

/// STL in ASCII, mm, a closed solid for each panel, named after its row and column. `shape_mm` has
/// the folded vertices (3 x vertices) whose mid-planes the flat solids are laid into.
std::string plate_stl(const Pattern& base, const solver::Panels& panels,
                      const Eigen::Matrix2Xd& flat_mm,
                      const std::vector<solver::PlateSolid>& solids,
                      const Eigen::Matrix3Xd& shape_mm);

}  // namespace misalign::schema
