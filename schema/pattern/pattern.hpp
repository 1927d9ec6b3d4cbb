// Defines a pattern: the perforated sheet, its shifts, and the sampling of its path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/verdict/criterion.hpp"

namespace misalign::schema {

/// The folded state for which a mesh was designed.
struct FoldedTarget {
  Eigen::Matrix3Xd vertices_mm;  ///< axes are those of the file
  double pilot_deg;
};

struct Pattern {
  Json family;  ///< "family" and its keys, resolved: without defaults or files
  solver::PerforatedSheet base;
  Eigen::Matrix2Xd shifts_mm;  ///< displacements of the file, one column per vertex
  /// Largest distance of a mesh that does not fold rigidly from its base (these shifts are part of
  /// `shifts_mm`, except a campaign's); 0 if it is the base.
  double mesh_off_mm = 0;
  std::vector<std::string> reading{};  ///< sentences about the interpretation of the mesh

  std::optional<FoldedTarget> folded_target{};

  solver::FlatVertices vertices_mm() const { return base.sheet.vertices_mm + shifts_mm; }
};

/// Displacements in a pattern are allowed or refused.
enum class Displacements { allowed, refused };

/// Samples of a path, and faults between them.
struct Sampling {
  double sample_deg = 1, end_deg = 180;
  solver::BumpRule between_samples = solver::BumpRule::ignored;
  /// The filling whose energy has to fall; none: all diagonals have to be monotone.
  std::optional<solver::Fill> energy_of = std::nullopt;

  /// Returns the criterion, without margins.
  solver::Criterion criterion() const {
    solver::Criterion criterion{between_samples};
    if (energy_of) criterion.energy = solver::EnergyCriterion{*energy_of};
    return criterion;
  }
};

/// Returns [row, column] of a facet.
Json facet_json(const Pattern& pattern, int facet);
/// Returns the facet at [row, column]; -1 if the sheet has none.
int facet_of_json(const Pattern& pattern, const Json& place);

}  // namespace misalign::schema
