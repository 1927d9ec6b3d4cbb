// Finds the base of a mesh and its folding, by its mountains and valleys as far as these are given
// or follow from one another; otherwise that of a sheet near it.
#pragma once

#include <span>

#include "schema/pattern/mesh_family.hpp"
#include "schema/pattern/pattern.hpp"

namespace misalign::schema {

/// Folds the base of `pattern`, which has the mesh's sheet and holes and no shifts yet. A mesh with
/// a target folds to it (target_base.hpp), with the first of `pilots` that serves. The base of
/// a mesh that does not fold rigidly is the nearest sheet found that does, and the mesh's vertices
/// are shifts of it. A campaign draws its own shifts and is refused unless the base is near enough
/// to represent the mesh. A fault names the vertex if there is no base.
void fold_base(const FamilyMesh& mesh, std::span<const int> pilots, Displacements displacements,
               Pattern& pattern, InputFaults& faults);

}  // namespace misalign::schema
