// Writes the study of shapes as JSON.
#pragma once

#include <string>

#include "schema/pattern/pattern.hpp"
#include "schema/pattern/target.hpp"
#include "solver/shape/shape.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// Names as in files and options.
struct ShapeKindName {
  const char* name;
  solver::ShapeKind kind;
};
inline constexpr ShapeKindName kShapeKinds[] = {{"shape", solver::ShapeKind::free},
                                                {"rest", solver::ShapeKind::rest},
                                                {"energy", solver::ShapeKind::rest_by_energy},
                                                {"bistable", solver::ShapeKind::bistable}};
const char* name_of(solver::ShapeKind kind);
/// Names of limits: "corner", "edge", "fold_angle", "fold_limit", ...
const char* name_of(solver::ShapeRow::Kind kind);
/// The place of a limit: a facet, an edge, a crease, a diagonal or a goal.
std::string place_of(const Pattern& base, const solver::Mechanism& mechanism,
                     const solver::ShapeOptions& options, const solver::ShapeLimit& limit);

/// The study of a shaped sheet: the target, the distances in mm, the pose, what holds the sheet
/// there and what limits it.
Json shape_json(const Pattern& base, const Target& target, const solver::Sheet& sheet,
                const solver::ShapeOptions& options, const solver::ShapeStudy& study);

}  // namespace misalign::schema
