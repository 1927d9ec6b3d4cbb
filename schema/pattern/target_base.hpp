// Finds the folding of a mesh from the folded state for which it was designed.
#pragma once

#include <span>

#include "schema/pattern/mesh_family.hpp"
#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Sets folding and target of `pattern`, which has the mesh's sheet and holes: the base's closed
/// form if the whole mesh folds rigidly to its target, otherwise the path of the perforated sheet,
/// followed from the target with the first of `pilots` with which it comes to flat. Lengths that
/// differ slightly are closed by the nearest sheet. Faults name edges, panels and creases. Returns
/// false if the target is only a drawing: no key names it and its panels are not those of the mesh.
bool fold_from_target(const FamilyMesh& mesh, std::span<const int> pilots, Pattern& pattern,
                      InputFaults& faults);

}  // namespace misalign::schema
