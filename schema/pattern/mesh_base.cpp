#include "schema/pattern/mesh_base.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "schema/pattern/folding_fault.hpp"
#include "schema/pattern/sheet_places.hpp"
#include "schema/pattern/target_base.hpp"
#include "solver/pattern/nearest_base.hpp"

namespace misalign::schema {
namespace {

// Creases of a base whose assignment follows from others, or from the pilot.
struct Unassigned {
  int creases = 0;
  bool are_all = true;
};

Unassigned unassigned(const solver::CreasePattern& sheet, const std::vector<int>& holes,
                      const std::vector<int>& assignment) {
  const auto is_hole = [&](int f) { return std::ranges::binary_search(holes, f); };
  Unassigned found;
  for (std::size_t e = 0; e < sheet.edges.size(); ++e) {
    const solver::Edge& edge = sheet.edges[e];
    if (edge.on_perimeter()) continue;
    found.are_all = found.are_all && assignment[e] == 0;
    found.creases += assignment[e] == 0 && !is_hole(edge.left) && !is_hole(edge.right);
  }
  return found;
}

// The folding with an unassigned pilot: a valley if no crease is assigned; otherwise as the others
// allow.
using Folded = std::variant<solver::BaseFolding, solver::NoBaseFolding>;
Folded fold_unassigned(const solver::CreasePattern& sheet, std::vector<int> assignment, int pilot) {
  const bool none = std::ranges::all_of(assignment, [](int sign) { return sign == 0; });
  assignment[static_cast<std::size_t>(pilot)] = 1;
  Folded valley = solver::fold_sequentially(sheet, assignment, pilot);
  if (none) return valley;
  assignment[static_cast<std::size_t>(pilot)] = -1;
  Folded mountain = solver::fold_sequentially(sheet, assignment, pilot);
  if (std::holds_alternative<solver::NoBaseFolding>(mountain)) return valley;
  if (std::holds_alternative<solver::NoBaseFolding>(valley)) return mountain;
  return solver::NoBaseFolding{solver::NoBaseFolding::Cause::ambiguous, sheet.edges[pilot].a,
                               pilot};
}

// Adds sentences about mountains and valleys that the file leaves open.
void say_what_follows(const std::vector<int>& assignment, int pilot, Pattern& pattern) {
  const solver::CreasePattern& sheet = pattern.base.sheet;
  const auto [creases, are_all] = unassigned(sheet, pattern.base.holes, assignment);
  if (creases == 0) return;
  pattern.reading.push_back(
      are_all ? "the mesh has no mountains and valleys: they follow from the pilot " +
                    solver::line_label(sheet.edges[pilot].a, sheet.edges[pilot].b) +
                    ", which is a valley"
              : "unassigned creases: " + std::to_string(creases) +
                    "; whether mountain or valley follows from the others");
}

// Takes a sheet near the mesh as its base, and the mesh as a shifted sheet. Campaigns draw around
// the base, which must represent the mesh.
void take_near_base(const std::string& where, solver::NearestBase near, Displacements displacements,
                    Pattern& pattern, InputFaults& faults) {
  solver::CreasePattern& sheet = pattern.base.sheet;
  pattern.mesh_off_mm = near.off_mm;
  pattern.reading.push_back(
      fmt::format("the mesh does not fold rigidly; its base is the nearest sheet found that does, "
                  "off by at most {:.3g} mm",
                  near.off_mm));
  if (displacements == Displacements::allowed) {
    pattern.shifts_mm = sheet.vertices_mm - near.sheet.vertices_mm;
  } else if (near.off_mm > solver::kStandsFor_widths * sheet.panel_width_mm) {
    faults.add(
        where.empty() ? "the mesh" : where,
        "does not fold rigidly, and the nearest sheet found that does is off by " +
            shown_number(std::round(near.off_mm * 1e3) / 1e3) +
            " mm: a campaign draws shifts of a base that folds",
        "`misalign fold` and studies take it as a sheet; for a campaign correct the coordinates");
  }
  sheet = std::move(near.sheet);
  pattern.base.folding = std::move(near.folding);
  if (const auto none = place_faces(sheet)) {  // as in a second reading
    faults.add(where.empty() ? none->problem : where + ": " + none->problem, none->why,
               none->suggestion);
  }
  sheet.panel_width_mm = median_width_mm(sheet);
}

}  // namespace

void fold_base(const FamilyMesh& mesh, std::span<const int> pilots, Displacements displacements,
               Pattern& pattern, InputFaults& faults) {
  if (mesh.target && fold_from_target(mesh, pilots, pattern, faults)) return;
  const int pilot = pilots.front();
  const auto& assignment = mesh.assignment;
  pattern.reading = mesh.reading;
  say_what_follows(assignment, pilot, pattern);
  auto folded = assignment[static_cast<std::size_t>(pilot)] == 0
                    ? fold_unassigned(pattern.base.sheet, assignment, pilot)
                    : solver::fold_sequentially(pattern.base.sheet, assignment, pilot);
  if (auto* folding = std::get_if<solver::BaseFolding>(&folded)) {
    pattern.base.folding = std::move(*folding);
    return;
  }
  const auto& none = std::get<solver::NoBaseFolding>(folded);
  if (none.unclosed) {
    if (auto near = solver::nearest_base(pattern.base.sheet, *none.unclosed)) {
      take_near_base(mesh.place, std::move(*near), displacements, pattern, faults);
      return;
    }
  }
  add_folding_fault(mesh.place, pattern.base.sheet, assignment, none, faults);
}

}  // namespace misalign::schema
