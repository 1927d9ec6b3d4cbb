// Reads and writes the pattern that an exported FOLD file carries beside its mesh. The mesh alone
// cannot be folded again: a shifted sheet without holes does not fold.
#pragma once

#include "schema/pattern/pattern_json.hpp"

namespace misalign::schema {

/// Key of the pattern in a FOLD object, written by pattern_json.
inline constexpr const char* kCarriedPattern = "misalign:pattern";

/// Returns edges_vertices, edges_assignment and faces_vertices of the perforated sheet: an edge is
/// "M" or "V" between two panels, otherwise "B".
Json perforated_mesh_json(const Pattern& pattern);

/// Reads the carried pattern. Faults if it is unreadable, or no longer that of the file's vertices
/// (1e-9 mm), edges, assignments and faces. Listed fillers (filled_mesh.hpp) belong to those, but
/// not to the pattern.
Pattern read_carried_pattern(const Json& fold, InputFaults& faults, Perforations perforations);

}  // namespace misalign::schema
