// The limits that an optimisation keeps, as people write them: "stroke_max <= 0.06",
// "miscut_margin_mm >= 0.1".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/files/input.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::schema {

struct OptimiseBounds {
  std::optional<double> stroke_max, largest_force_n;  ///< at most
  std::vector<solver::OptimiseFloor> floors;  ///< at least; of each goal one, as in their table

  bool operator==(const OptimiseBounds&) const = default;
};

/// Adds one; otherwise why not, and what to do.
struct BoundFault {
  std::string why, suggestion;
};
std::optional<BoundFault> add_bound(const std::string& text, OptimiseBounds& bounds);

/// All of them; UserError where one cannot be.
OptimiseBounds bounds_of(const std::vector<std::string>& subject_to);

/// As they are read, the upper ones first.
Json bounds_json(const OptimiseBounds& bounds);

}  // namespace misalign::schema
