// Chooses the facets that are holes and counts the degrees of freedom that they leave.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/pattern/base_folding.hpp"
#include "solver/pattern/spring_ends.hpp"

namespace misalign::solver {

/// A correct sheet with holes: what a campaign or a pattern file describes, before any shift.
struct PerforatedSheet {
  CreasePattern sheet;
  std::vector<int> holes;  ///< facet indices, ascending
  BaseFolding folding;
  SpringEnds springs{};
};

/// Facets that may be taken out: none of their vertices lies on the perimeter. Ascending.
std::vector<int> inner_facets(const CreasePattern& sheet);

/// Inner facets whose row + column is odd (remainder 1) or even (0), ascending.
std::vector<int> checkerboard(const CreasePattern& sheet, int remainder);

/// Errors in these holes, a sentence each; empty if all are inner facets and no two share an edge.
std::vector<std::string> hole_faults(const CreasePattern& sheet, const std::vector<int>& holes);

/// The first crease between two kept facets, in the order of edges: A2-A9 of the paper's sheet.
int default_pilot(const CreasePattern& sheet, const std::vector<int>& holes);

/// d.f. = 3j - (t + 6) of the panel truss, equation (2.1): j joints, t members, of which two are
/// the diagonals of each kept facet.
int counted_mobility(const CreasePattern& sheet, const std::vector<int>& holes);

/// Number of holes that leaves one degree of freedom by counting, or -1.
int holes_that_count_to_one(const CreasePattern& sheet);

/// All sets of `count` inner facets of which no two share an edge: each ascending, in lexicographic
/// order. None if there are more than `most`, or if the search takes longer than a few seconds.
std::optional<std::vector<std::vector<int>>> separate_facets(const CreasePattern& sheet, int count,
                                                             std::size_t most);

}  // namespace misalign::solver
