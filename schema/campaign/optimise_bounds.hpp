// Reads and writes the constraints of an optimisation: "stroke_max <= 0.06", "miscut_margin_mm >=
// 0.1".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::schema {

struct OptimiseBounds {
  std::optional<double> stroke_max, largest_force_n;  ///< upper bounds
  std::vector<solver::OptimiseFloor> floors;  ///< bounds of goals, in the order of their table

  bool operator==(const OptimiseBounds&) const = default;
};

/// Adds a constraint, or returns its fault and a suggestion.
struct BoundFault {
  std::string why, suggestion;
};
std::optional<BoundFault> add_bound(const std::string& text, OptimiseBounds& bounds);

/// Reads all constraints; UserError if one is impossible.
OptimiseBounds bounds_of(const std::vector<std::string>& subject_to);

/// Returns the constraints as they are read, the upper ones first.
Json bounds_json(const OptimiseBounds& bounds);

}  // namespace misalign::schema
