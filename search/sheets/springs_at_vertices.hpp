// What knows springs on the vertices of the diagonals alone.
#pragma once

#include <fmt/format.h>

#include "schema/files/user_error.hpp"
#include "solver/pattern/spring_ends.hpp"

namespace misalign::search {

/// UserError (bad_request) where springs end beside the vertices. `what` are about springs that do
/// not: "certify: proofs".
inline void need_springs_at_vertices(const solver::SpringEnds& springs, const std::string& what) {
  if (springs.at_vertices()) return;
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format(
          "{} are of springs on the vertices, and these end {:g} mm beside them, {:g} mm off "
          "the mid-plane (\"springs.attach\"); take \"springs\" out of the pattern for a "
          "sheet with springs on its vertices",
          what, springs.inset_mm, springs.offset_mm));
}

}  // namespace misalign::search
