// A pattern, the perforated sheet it stands for, and where its path is looked at.
#pragma once

#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/verdict/between.hpp"

namespace misalign::schema {

struct Pattern {
  Json family;  ///< "family" and the keys of that family, resolved: no default, no file left
  solver::PerforatedSheet base;
  Eigen::Matrix2Xd shifts_mm;  ///< the file's displacements, one column per vertex
  /// How far a mesh that does not fold rigidly is at most from the base that was found for it (its
  /// own shifts are among `shifts_mm`, but for a campaign's); 0 where it is the base itself.
  double mesh_off_mm = 0;
  std::vector<std::string> reading{};  ///< sentences: how a mesh was taken that leaves a choice

  solver::FlatVertices vertices_mm() const { return base.sheet.vertices_mm + shifts_mm; }
};

/// A pattern's shifts of its own are allowed or refused.
enum class Displacements { allowed, refused };

/// Where a path is looked at, and what counts as a fault between.
struct Sampling {
  double sample_deg = 1, end_deg = 180;
  solver::BumpRule between_samples = solver::BumpRule::ignored;
};

/// [row, column] of a facet.
Json facet_json(const Pattern& pattern, int facet);
/// The facet there; -1 if the sheet has none.
int facet_of_json(const Pattern& pattern, const Json& place);

}  // namespace misalign::schema
