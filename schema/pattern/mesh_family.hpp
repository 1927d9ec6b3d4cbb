// The families of unperforated sheets that a pattern can name, each with keys of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

struct FamilyMesh {
  Json family;        ///< "family" and its keys, resolved
  std::string place;  ///< what a sentence calls the mesh; empty: it is the document itself
  solver::CreasePattern sheet;
  std::vector<int> assignment;         ///< per edge: +1 valley, -1 mountain, 0 unknown or border
  std::vector<int> missing;            ///< facets that the family itself leaves out
  std::vector<std::string> reading{};  ///< sentences: how a mesh was taken that leaves a choice
};

/// The sheet that a pattern object names. Only when it added no fault is the result usable. A
/// mesh's file is looked for in `directory`; without one none may be named.
FamilyMesh read_family(ObjectReader& reader, const std::optional<std::filesystem::path>& directory);

}  // namespace misalign::schema
