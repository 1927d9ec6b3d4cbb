// Shapes the sheet of a pattern file to its target, and proves where it rests.
#pragma once

#include <functional>

#include "schema/campaign/optimise_bounds.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/certificate/energy_wells.hpp"
#include "solver/contact/contact.hpp"
#include "solver/shape/shape.hpp"

namespace misalign::search {

/// The request for a shape, as typed: the file's target and design complete it.
struct ShapeInput {
  solver::ShapeOptions options;  ///< all but target, angles and floors
  std::optional<double> at_deg;  ///< none: the target's, or where the filling rests, or 90
  double barrier_n_mm = 0;       ///< energy of the design's springs
  schema::OptimiseBounds bounds;
};

struct ShapedSheet {
  solver::ShapeOptions options;
  solver::ShapeStudy study;
  schema::Design design;  ///< its angles of rest and of use are set
  std::optional<solver::Contact> contact;
  /// Proof of its wells; none for a shape alone, or where no proof applies.
  std::optional<solver::EnergyWells> wells;
  /// The stowed angle to which it is driven, proven, all diagonals monotone where they have to be,
  /// and without contact; 0: none.
  double used_from_deg = 0;
};

/// The target of a sheet. UserError, which calls it `name`: 3 where it has none.
const schema::Target& target_of(const std::optional<schema::Target>& target,
                                const std::string& name);
/// The pilot angle of a target: its `at_deg`, or where springs rest, or 90.
double shape_deg(const schema::Target& target, const std::optional<double>& rest_deg);

/// Shapes the base of a file, whose shifts do not matter. UserError: 3 where the file has no
/// target, 2 where an option does not fit, 1 where its path is lost.
ShapedSheet shaped(const schema::PatternFile& file, const std::string& name,
                   const ShapeInput& input);

/// The sheet as a pattern file, with its target and design.
schema::Json shaped_pattern(const schema::PatternFile& file, const ShapedSheet& shaped);

/// The sheet at its shape, on the target, as an SVG file.
std::string shape_picture(const schema::PatternFile& file, const std::string& name,
                          const ShapedSheet& shaped);

/// The target, the distances, the springs that hold it, and what limits it.
std::string shape_text(const schema::PatternFile& file, const std::string& name,
                       const ShapedSheet& shaped);
schema::Json shape_json(const schema::PatternFile& file, const ShapedSheet& shaped);

}  // namespace misalign::search
