// Reads the families of unperforated sheets that a pattern can name, each with its own keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "schema/pattern/mesh_target.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

struct FamilyMesh {
  Json family;        ///< "family" and its keys, resolved
  std::string place;  ///< the mesh's name in a sentence; empty: the document itself
  solver::CreasePattern sheet;
  std::vector<int> assignment;         ///< per edge: +1 valley, -1 mountain, 0 unknown or border
  std::vector<int> missing;            ///< facets that the family leaves out
  std::vector<std::string> reading{};  ///< sentences about the interpretation of the mesh
  std::optional<MeshTarget> target{};
};

/// Reads the sheet that a pattern object names; usable only without faults. A mesh's file is
/// relative to `directory`; without one no file may be named.
FamilyMesh read_family(ObjectReader& reader, const std::optional<std::filesystem::path>& directory);

}  // namespace misalign::schema
