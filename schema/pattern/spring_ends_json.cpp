#include "schema/pattern/spring_ends_json.hpp"

#include "schema/pattern/pattern_file.hpp"
#include "schema/pattern/perforation_check.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::schema {
namespace {

// Whether a panel has the point within its edges.
bool contains(const solver::PerforatedSheet& base, int facet, const solver::Vec3<double>& point,
              const solver::SheetGeometry<double>& geometry) {
  const std::array<int, 4>& corners = base.sheet.facets[static_cast<std::size_t>(facet)];
  for (std::size_t k = 0; k < 4; ++k) {
    const auto from = flat_point(geometry, corners[k]);
    if (!(cross(flat_point(geometry, corners[(k + 1) % 4]) - from, point - from).z > 0))
      return false;
  }
  return true;
}

// The first panel that has an end beyond its edges; -1: none.
int panel_too_small(const solver::PerforatedSheet& base) {
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  solver::SheetGeometry<double> geometry;
  place(mechanism, base.sheet.vertices_mm, geometry);
  for (const solver::Loop& loop : mechanism.loops) {
    for (int corner = 0; loop.hole >= 0 && corner < 4; ++corner) {
      const int facet = loop.carriers[static_cast<std::size_t>(corner)].facet;
      if (!contains(base, facet, spring_end(mechanism, geometry, loop, corner), geometry)) {
        return facet;
      }
    }
  }
  return -1;
}

}  // namespace

void read_spring_ends(ObjectReader& reader, Pattern& pattern) {
  constexpr double kMost_mm = 1e6;
  const Json* const value = reader.find("springs");
  if (!value) return;
  const std::size_t before = reader.faults().count();
  ObjectReader springs(*value, reader.name("springs"), reader.faults());
  const Json* const attach = springs.find("attach");
  springs.refuse_unknown_keys();
  if (!attach || *attach == "vertices") return;
  if (!attach->is_object()) {
    reader.faults().add(springs.shown("attach"), "is no place where springs end",
                        "write \"vertices\", or {\"inset_mm\": 6} for bores inside the panels");
    return;
  }
  solver::SpringEnds& ends = pattern.base.springs;
  ObjectReader place(*attach, springs.name("attach"), reader.faults());
  place.number("inset_mm", ends.inset_mm, 0, kMost_mm,
               "try 6: so far from the vertex, on the bisector of the panel's corner");
  place.number("offset_mm", ends.offset_mm, -kMost_mm, kMost_mm,
               "try 0 for the panels' mid-plane, or 1.5 above it");
  place.refuse_unknown_keys();
  if (reader.faults().count() > before || ends.at_vertices()) return;
  if (has_spare_equations(pattern.base)) {
    reader.faults().add(springs.name("attach"),
                        "sheets with so few holes are judged by closed forms of their vertices",
                        "write \"vertices\", or take more holes");
  }
  const int facet = ends.inset_mm > 0 ? panel_too_small(pattern.base) : -1;
  if (facet >= 0) {
    reader.faults().add(place.shown("inset_mm"),
                        "lies outside the panel " + facet_json(pattern, facet).dump(),
                        "take a smaller one");
  }
}

Json spring_ends_json(const solver::SpringEnds& springs) {
  return {{"attach", {{"inset_mm", springs.inset_mm}, {"offset_mm", springs.offset_mm}}}};
}

}  // namespace misalign::schema
