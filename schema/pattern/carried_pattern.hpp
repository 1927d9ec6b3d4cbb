// The pattern that an exported FOLD file carries beside its mesh. The mesh alone could not be
// folded again: a shifted sheet without holes does not fold.
#pragma once

#include "schema/pattern/pattern_json.hpp"

namespace misalign::schema {

/// The key of a FOLD object under which its pattern is, as pattern_json writes it.
inline constexpr const char* kCarriedPattern = "misalign:pattern";

/// edges_vertices, edges_assignment and faces_vertices of the perforated sheet: an edge is "M" or
/// "V" between two faces that are kept, otherwise "B".
Json perforated_mesh_json(const Pattern& pattern);

/// The carried pattern. Faults if it cannot be read, or is not that of the file's own vertices
/// (1e-9 mm), edges, assignments and faces any more; fillers that it lists (filled_mesh.hpp) are
/// among those, and no part of the pattern.
Pattern read_carried_pattern(const Json& fold, InputFaults& faults, Perforations perforations);

}  // namespace misalign::schema
