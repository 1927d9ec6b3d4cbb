#include "schema/pattern/spring_ends_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "schema/pattern/perforation_check.hpp"
#include "schema/pattern/vertex_labels.hpp"
#include "solver/kinematics/diagonals.hpp"

namespace misalign::schema {
namespace {

constexpr double kMost_mm = 1e6;
constexpr const char* kPointForm =
    R"({"hole": [1, 2], "vertex": "A10", "panel": [0, 1], "from_vertex_mm": [8, 0, 0]})";

// Returns whether a panel has the point within its edges.
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

// Returns the first carrier of an end beyond its panel's edges; a vertex is within them.
std::optional<solver::Loop::Carrier> carrier_too_small(const solver::PerforatedSheet& base) {
  const solver::Mechanism mechanism = solver::build_mechanism(base);
  solver::SheetGeometry<double> geometry;
  place(mechanism, base.sheet.vertices_mm, geometry);
  for (const solver::Loop& loop : mechanism.loops) {
    for (int corner = 0; loop.hole >= 0 && corner < 4; ++corner) {
      const solver::Loop::Carrier& carrier = loop.carriers[static_cast<std::size_t>(corner)];
      const auto end = spring_end(mechanism, geometry, loop, corner);
      if (carrier.place_mm.head<2>().isZero(0) || contains(base, carrier.facet, end, geometry)) {
        continue;
      }
      return carrier;
    }
  }
  return std::nullopt;
}

// Reads a point at another place; wrong values are faults of `where`.
std::optional<solver::SpringEnds::Own> read_point(const Json& value, const std::string& where,
                                                  const Pattern& pattern, InputFaults& faults) {
  const solver::PerforatedSheet& base = pattern.base;
  const std::size_t before = faults.count();
  ObjectReader point(value, where, faults);
  for (const char* key : {"hole", "vertex", "panel", "from_vertex_mm"}) {
    point.require(key, "write " + std::string(kPointForm));
  }
  const Json *const hole = point.find("hole"), *const vertex = point.find("vertex"),
                    *const panel = point.find("panel"), *const place = point.find("from_vertex_mm");
  point.refuse_unknown_keys();
  if (faults.count() > before) return std::nullopt;
  const auto refuse = [&](const char* key, const std::string& why, const std::string& suggestion) {
    faults.add(point.shown(key), why, suggestion);
    return std::nullopt;
  };
  solver::SpringEnds::Own end{
      facet_of_json(pattern, *hole), -1, facet_of_json(pattern, *panel), {}};
  const auto is_hole = [&](int f) { return std::ranges::binary_search(base.holes, f); };
  if (end.hole < 0 || !is_hole(end.hole)) {
    return refuse("hole", "is no hole of this sheet",
                  "write the [row, column] of the hole whose spring it is");
  }
  const auto& corners = base.sheet.facets[static_cast<std::size_t>(end.hole)];
  if (vertex->is_string()) {
    end.vertex = vertex_of_label(vertex->get<std::string>(), base.sheet.vertex_count());
  }
  if (std::ranges::find(corners, end.vertex) == corners.end()) {
    std::vector<std::string> labels;
    for (const int v : corners) labels.push_back(solver::vertex_label(v));
    return refuse("vertex", "is no corner of the hole " + hole->dump(),
                  fmt::format("its corners are {}", fmt::join(labels, ", ")));
  }
  std::vector<std::string> panels;
  bool is_there = false;
  for (const int f : solver::facets_around(base.sheet, end.vertex)) {
    if (is_hole(f)) continue;
    panels.push_back(facet_json(pattern, f).dump());
    is_there |= f == end.panel;
  }
  if (!is_there) {
    return refuse("panel", "is no panel at " + solver::vertex_label(end.vertex),
                  fmt::format("the panels there are {}", fmt::join(panels, ", ")));
  }
  const bool is_place =
      place->is_array() && place->size() == 3 && std::ranges::all_of(*place, [](const Json& x) {
        return x.is_number() && std::abs(x.get<double>()) <= kMost_mm;
      });
  if (!is_place) {
    return refuse("from_vertex_mm", "must be three numbers",
                  "write [8, 0, 0]: along the bisector of the panel's corner, to its left, up");
  }
  end.place_mm = {(*place)[0].get<double>(), (*place)[1].get<double>(), (*place)[2].get<double>()};
  return end;
}

void read_points(ObjectReader& attach, Pattern& pattern) {
  const Json* const list = attach.find("points");
  if (!list) return;
  InputFaults& faults = attach.faults();
  if (!list->is_array()) {
    faults.add(attach.shown("points"), "must be a list", "write [" + std::string(kPointForm) + "]");
    return;
  }
  std::vector<solver::SpringEnds::Own>& ends = pattern.base.springs.own;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string where = fmt::format("{}[{}]", attach.name("points"), i);
    const auto end = read_point((*list)[i], where, pattern, faults);
    if (!end) continue;
    const bool is_known = std::ranges::any_of(ends, [&](const solver::SpringEnds::Own& other) {
      return other.hole == end->hole && other.vertex == end->vertex;
    });
    if (is_known) faults.add(where, "repeats a spring's end", "name each once");
    ends.push_back(*end);
  }
}

}  // namespace

void read_spring_ends(ObjectReader& reader, Pattern& pattern) {
  const Json* const value = reader.find("springs");
  if (!value) return;
  const std::size_t before = reader.faults().count();
  ObjectReader springs(*value, reader.name("springs"), reader.faults());
  const Json* const attach = springs.find("attach");
  springs.refuse_unknown_keys();
  if (!attach || *attach == "vertices") return;
  if (!attach->is_object()) {
    reader.faults().add(springs.shown("attach"), "is no place of springs' ends",
                        "write \"vertices\", or {\"inset_mm\": 6} for bores inside the panels");
    return;
  }
  solver::SpringEnds& ends = pattern.base.springs;
  ObjectReader place(*attach, springs.name("attach"), reader.faults());
  place.number("inset_mm", ends.inset_mm, 0, kMost_mm,
               "try 6: mm from the vertex, on the bisector of the panel's corner");
  place.number("offset_mm", ends.offset_mm, -kMost_mm, kMost_mm,
               "try 0 for the panels' mid-plane, or 1.5 above it");
  read_points(place, pattern);
  place.refuse_unknown_keys();
  if (reader.faults().count() > before || ends.at_vertices()) return;
  if (is_overconstrained(pattern.base)) {
    reader.faults().add(springs.name("attach"),
                        "overconstrained sheets are judged by closed forms of their vertices",
                        "write \"vertices\", or take more holes");
  }
  if (const auto carrier = carrier_too_small(pattern.base)) {
    const Eigen::Vector3d& at_mm = carrier->place_mm;
    reader.faults().add(
        fmt::format("{}: [{:g}, {:g}] mm", springs.name("attach"), at_mm.x(), at_mm.y()),
        "lies outside the panel " + facet_json(pattern, carrier->facet).dump(),
        "take a smaller inset_mm, or another point");
  }
}

Json spring_ends_json(const Pattern& pattern) {
  const solver::SpringEnds& springs = pattern.base.springs;
  Json attach = {{"inset_mm", springs.inset_mm}, {"offset_mm", springs.offset_mm}};
  for (const solver::SpringEnds::Own& end : springs.own) {
    attach["points"].push_back(
        {{"hole", facet_json(pattern, end.hole)},
         {"vertex", solver::vertex_label(end.vertex)},
         {"panel", facet_json(pattern, end.panel)},
         {"from_vertex_mm", {end.place_mm.x(), end.place_mm.y(), end.place_mm.z()}}});
  }
  return {{"attach", attach}};
}

}  // namespace misalign::schema
