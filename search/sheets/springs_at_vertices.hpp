// Refuses springs off the vertices of the diagonals, for studies that know no others.
#pragma once

#include <fmt/format.h>

#include "schema/files/user_error.hpp"
#include "solver/pattern/spring_ends.hpp"

namespace misalign::search {

inline std::string where_springs_end(const solver::SpringEnds& springs) {
  std::string text = fmt::format("{:g} mm inside the panels, {:g} mm off their mid-plane",
                                 springs.inset_mm, springs.offset_mm);
  if (!springs.own.empty()) {
    text += fmt::format(", {} of them at points of their own", springs.own.size());
  }
  return text;
}

/// UserError (bad_request): `what` ("certify: proofs") need springs `where` ("on the vertices"),
/// but these end elsewhere.
[[noreturn]] inline void refuse_springs(const solver::SpringEnds& springs, const std::string& what,
                                        const std::string& where) {
  throw schema::UserError(
      schema::Cause::bad_request,
      fmt::format("{} need springs {}, but these end {} (\"springs.attach\"); take \"springs\" "
                  "out of the pattern for a sheet with springs on its vertices",
                  what, where, where_springs_end(springs)));
}

inline void need_springs_at_vertices(const solver::SpringEnds& springs, const std::string& what) {
  if (!springs.at_vertices()) refuse_springs(springs, what, "on the vertices");
}
/// Lengths off the mid-plane are no even functions of the pilot angle.
inline void need_springs_in_mid_plane(const solver::SpringEnds& springs, const std::string& what) {
  if (!springs.in_mid_plane()) refuse_springs(springs, what, "in the panels' mid-plane");
}

}  // namespace misalign::search
