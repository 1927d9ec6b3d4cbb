// Reads the folded state for which a mesh was designed: a folded form of its FOLD file, or a second
// file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "schema/files/input.hpp"
#include "schema/pattern/fold_format.hpp"
#include "solver/pattern/isometric_pair.hpp"

namespace misalign::schema {

struct MeshTarget {
  std::string name;  ///< the frame or the file, in a sentence
  bool is_named;     ///< true: by a key; otherwise it is the only folded form of the file
  solver::FoldedVertices vertices_mm;
};

/// Reads the keys "target_frame", the number of a folded form in file_frames of `document`, or
/// "target_file", the name of a FOLD or OBJ file; without them the only folded form of `document`,
/// if there is one. The target has the vertices of `mesh`, three numbers each, and its faces or
/// none.
std::optional<MeshTarget> read_mesh_target(ObjectReader& reader, const Json& document,
                                           const std::optional<std::filesystem::path>& directory,
                                           double mm_per_unit, const FoldMesh& mesh);

/// Adds a folded form of the mesh to a FOLD object: a frame that inherits the rest.
void add_folded_form(const Eigen::Matrix3Xd& vertices_mm, Json& fold);

}  // namespace misalign::schema
