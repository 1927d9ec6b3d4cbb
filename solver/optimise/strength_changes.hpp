// Linearises the strength of panels, and the clearance of springs.
#pragma once

#include <vector>

#include "solver/optimise/local_goals.hpp"

namespace misalign::solver {

// Stress and buckling follow the springs' forces on bent panels; compliances and poses are held,
// whose changes are small beside those of the forces.
/// The negative stress, MPa, of the panels and angles that have most.
std::vector<GoalTerm> local_stress(SheetChanges& changes);
/// The buckling factor of the panels that have least, each at its worst angle.
std::vector<GoalTerm> local_buckling(SheetChanges& changes);
/// The clearance of the closest pairs of springs, and of the spring and panel that are closest, mm,
/// with the bodies of the options. None where springs end beside the vertices, or nothing is close.
std::vector<GoalTerm> local_spring_clearance(SheetChanges& changes);

}  // namespace misalign::solver
