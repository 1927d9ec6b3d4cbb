// The pattern that an exported FOLD file carries beside its mesh, so that it can be folded again: a
// shifted sheet without holes does not fold, so the mesh alone would not do.
#pragma once

#include "schema/pattern_file.hpp"

namespace misalign::schema {

/// The key of a FOLD object under which its pattern is, as pattern_json writes it.
inline constexpr const char* kCarriedPattern = "misalign:pattern";

/// The faces that are kept, as the corners of each.
Json faces_json(const Pattern& pattern);

/// The carried pattern. Faults if it cannot be read, or is not that of the file's own vertices
/// (1e-9 mm) and faces any more.
Pattern read_carried_pattern(const Json& fold, InputFaults& faults, Perforations perforations);

}  // namespace misalign::schema
