// Reads and writes which energy judges a sheet: "by" and "fill" of campaigns and exported
// candidates.
#pragma once

#include <optional>

#include "schema/files/input.hpp"
#include "solver/fill/fill.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::schema {

/// Reads "by" and "fill": the filling whose energy has to fall, relaxed flat and equal in all holes
/// (springs of 50 N/mm if no filling is given); none if all diagonals have to be monotone, or "by"
/// is a fault.
std::optional<solver::Fill> read_judging_fill(ObjectReader& reader,
                                              const solver::PerforatedSheet& base);

/// Returns whether a filling is relaxed flat, so that its energy can be followed there.
bool drives_to_flat(const solver::Fill& fill);
/// Returns whether sheets can be judged by it: it is equal in all holes, too.
bool can_judge(const solver::Fill& fill);

/// Returns both keys; the filling as `read_judging_fill` returns it.
Json judging_fill_json(const std::optional<solver::Fill>& fill);

}  // namespace misalign::schema
