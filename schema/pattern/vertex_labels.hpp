// Finds vertices by their names in files: "A1" is the first.
#pragma once

#include <string>

namespace misalign::schema {

/// Returns the vertex of a label, -1 if the sheet has no such vertex.
int vertex_of_label(const std::string& label, int vertex_count);

}  // namespace misalign::schema
