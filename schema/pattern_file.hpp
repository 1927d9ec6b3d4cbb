// A pattern as people write it, and the perforated sheet it stands for.
#pragma once

#include <map>
#include <string>

#include "schema/input.hpp"
#include "solver/history.hpp"
#include "solver/miura.hpp"

namespace misalign::schema {

struct Pattern {
  solver::MiuraShape shape{6, 6, 80, 80, 40};
  solver::PerforatedSheet base;
  Eigen::Matrix2Xd shifts_mm;  ///< the file's displacements, one column per vertex

  solver::FlatVertices vertices_mm() const { return base.sheet.vertices_mm + shifts_mm; }
};

enum class Displacements { allowed, refused };

/// Reads and checks a pattern object at `where`. Only when it added no fault is the result usable.
Pattern read_pattern(const Json& value, const std::string& where, Displacements displacements,
                     InputFaults& faults);

/// A pattern file; UserError (3) with every fault.
Pattern read_pattern_file(const std::string& path);

/// The base with these shifts, in the contract's names; displacements only where there are some.
/// Reading it again gives the same pattern.
Json pattern_json(const Pattern& base, const Eigen::Matrix2Xd& shifts_mm);

/// {"A10": [0.4, 0.0], ...}: the vertices that are shifted, exactly.
Json displacements_json(const Eigen::Matrix2Xd& shifts_mm);

/// [row, column] of a facet.
Json facet_json(const Pattern& pattern, int facet);

/// Vertex of a label, -1 if the sheet has no such vertex.
int vertex_of_label(const std::string& label, int vertex_count);

}  // namespace misalign::schema
