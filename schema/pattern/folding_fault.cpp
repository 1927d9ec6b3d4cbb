#include "schema/pattern/folding_fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

std::string edge_label(const solver::CreasePattern& sheet, int e) {
  return solver::line_label(sheet.edges[e].a, sheet.edges[e].b);
}

const char* word_of(int sign) { return sign > 0 ? "valley" : sign < 0 ? "mountain" : "not known"; }

// Returns "A8-A9 mountain, A9-A10 valley, ...", and notes creases that follow from others.
std::string creases_text(const solver::CreasePattern& sheet, const std::vector<int>& assignment,
                         const solver::NoBaseFolding::Creases& creases) {
  std::string text;
  for (int k = 0; k < 4; ++k) {
    const int e = creases.edges[k];
    text += (k ? ", " : "") + edge_label(sheet, e) + " " + word_of(creases.signs[k]);
    if (assignment[e] == 0 && creases.signs[k] != 0) text += " because of its other end";
  }
  return text;
}

// Suggests a change, as far as the sector angles tell.
std::string advice(const solver::CreasePattern& sheet,
                   const solver::NoBaseFolding::Creases& creases) {
  if (creases.odd.empty()) {
    return "no mountains and valleys fold it with its sector angles: correct the coordinates";
  }
  if (creases.wrong >= 0) {
    const auto at = std::find(creases.edges.begin(), creases.edges.end(), creases.wrong);
    const int sign = creases.signs[static_cast<std::size_t>(at - creases.edges.begin())];
    return "make " + edge_label(sheet, creases.wrong) + " a " + word_of(-sign);
  }
  std::vector<std::string> ones;
  for (const int e : creases.odd) ones.push_back(edge_label(sheet, e));
  int sum = 0;
  for (const int sign : creases.signs) sum += sign;
  std::string instead;
  for (int k = 0; k < 4; ++k) {  // three creases of a kind and one of the other
    if (std::abs(sum) == 2 && creases.signs[k] * sum < 0) {
      instead = ", not " + edge_label(sheet, creases.edges[k]);
    }
  }
  return fmt::format("by its sector angles the one that differs from the other three must be {}{}",
                     fmt::join(ones, " or "), instead);
}

// Suggests assignments that leave one way to fold.
std::string ambiguity_advice(const solver::CreasePattern& sheet, const std::vector<int>& assignment,
                             int edge) {
  if (std::ranges::all_of(assignment, [](int sign) { return sign == 0; })) {
    return "say which creases are mountains and valleys: M and V in edges_assignment of FOLD, in "
           "OBJ lines (l) in groups (g) named mountain and valley";
  }
  return edge < 0 ? "give the edges of holes an assignment, M or V"
                  : "give " + edge_label(sheet, edge) + " an assignment, M or V";
}

}  // namespace

void add_folding_fault(const std::string& place, const solver::CreasePattern& sheet,
                       const std::vector<int>& assignment, const solver::NoBaseFolding& none,
                       InputFaults& faults) {
  const std::string vertex = "vertex " + solver::vertex_label(none.vertex);
  const std::string where = place.empty() ? "the mesh" : place;
  const auto tenth = [](double value) { return shown_number(std::round(value * 1e4) / 1e4); };
  switch (none.cause) {
    case solver::NoBaseFolding::Cause::assignment:
      if (none.creases) {
        faults.add((place.empty() ? "" : place + ": ") + vertex,
                   "cannot fold with its mountains and valleys: " +
                       creases_text(sheet, assignment, *none.creases),
                   advice(sheet, *none.creases));
      } else {
        faults.add(where, vertex + " cannot fold with its mountains and valleys",
                   "check the assignments round it: three of a kind and one of the other");
      }
      break;
    case solver::NoBaseFolding::Cause::open:
      faults.add(where,
                 "the unperforated sheet does not fold rigidly: with the pilot at " +
                     tenth(none.pilot_deg) + " deg " + vertex + " folds " +
                     edge_label(sheet, none.edge) + " by " + tenth(none.angle_deg) +
                     " deg, its other end by " + tenth(none.other_angle_deg),
                 "correct the coordinates or the assignments there");
      break;
    case solver::NoBaseFolding::Cause::ambiguous:
      faults.add(where, vertex + " can fold in two ways that agree with all assignments known",
                 ambiguity_advice(sheet, assignment, none.edge));
      break;
    case solver::NoBaseFolding::Cause::unconnected:
      faults.add(where, vertex + " is not reached from the pilot over inner creases",
                 "give a sheet with connected inner vertices");
  }
}

}  // namespace misalign::schema
