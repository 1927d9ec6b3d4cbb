// Reads and writes the mesh of a perforated sheet with fillers in its holes
// (solver/kinematics/filler.hpp) as FOLD.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/pattern.hpp"
#include "solver/kinematics/filler.hpp"

namespace misalign::schema {

/// Key of a FOLD object that lists its fillers: {"hole": [1, 2], "vertex": "A17", "hinges": "MVM",
/// "faces": [28, 29], "apex": 49}, the last two counted from 0, as in FOLD.
inline constexpr const char* kFillers = "misalign:fillers";

struct MeshFiller {
  solver::Filler filler;
  std::string hinges;  ///< "M" or "V" of edges before-corner, corner-apex and corner-after
};

/// Returns the edges before-corner, corner-apex and corner-after of the filler with this number.
std::array<std::size_t, 3> hinge_edges(const solver::CreasePattern& sheet,
                                       const solver::Filler& filler, std::size_t number);

/// Adds fillers to edges_vertices, edges_assignment and faces_vertices of perforated_mesh_json:
/// each has one vertex more, three edges and two faces. Returns their list for kFillers.
Json add_fillers(const Pattern& pattern, const std::vector<MeshFiller>& fillers, Json& mesh);

/// Reads the fillers of a FOLD object, only the keys that add_fillers cannot compute; empty without
/// a list, none if the list does not fit this pattern.
std::optional<std::vector<MeshFiller>> read_fillers(const Json& fold, const Pattern& pattern);

}  // namespace misalign::schema
