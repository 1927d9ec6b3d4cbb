// The mesh of a perforated sheet with fillers in its holes (solver/kinematics/filler.hpp), as FOLD
// has it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/pattern/pattern.hpp"
#include "solver/kinematics/filler.hpp"

namespace misalign::schema {

/// The key of a FOLD object that lists its fillers: {"hole": [1, 2], "vertex": "A17", "hinges":
/// "MVM", "faces": [28, 29], "apex": 49}, the last two counted from 0 as FOLD does.
inline constexpr const char* kFillers = "misalign:fillers";

struct MeshFiller {
  solver::Filler filler;
  std::string hinges;  ///< "M" or "V" of before-corner, corner-apex and corner-after
};

/// The edges before-corner, corner-apex and corner-after of the filler with this number.
std::array<std::size_t, 3> hinge_edges(const solver::CreasePattern& sheet,
                                       const solver::Filler& filler, std::size_t number);

/// Adds them to edges_vertices, edges_assignment and faces_vertices of perforated_mesh_json: each
/// has one vertex more, three edges and two faces. Returns their list for kFillers.
Json add_fillers(const Pattern& pattern, const std::vector<MeshFiller>& fillers, Json& mesh);

/// Those of a FOLD object, of which only what add_fillers cannot know is read; none where it has no
/// list, nothing where the list is none of this pattern's.
std::optional<std::vector<MeshFiller>> read_fillers(const Json& fold, const Pattern& pattern);

}  // namespace misalign::schema
