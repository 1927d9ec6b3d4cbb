// How the base of a mesh folds: as its mountains and valleys say, as far as these follow from one
// another, or as that of a sheet near it.
#pragma once

#include "schema/pattern/mesh_family.hpp"
#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// The folding of `pattern`, which has the mesh's sheet and holes and no shifts yet. A mesh that
/// does not fold rigidly gets the nearest sheet found that does as its base, and its own vertices
/// as shifts of that; a campaign draws its own and is refused unless the base is as near as to
/// stand for the mesh. A sentence names the vertex where there is neither.
void fold_base(const FamilyMesh& mesh, int pilot, Displacements displacements, Pattern& pattern,
               InputFaults& faults);

}  // namespace misalign::schema
