// Pairs the panels of a sheet, each two with what they have in common: those that might meet.
#pragma once

#include <array>
#include <vector>

#include "solver/model/panels.hpp"

namespace misalign::solver {

enum class ContactKind {
  apart,   ///< panels without a common vertex: their distance is 0
  vertex,  ///< with one common vertex: a ray from it lies in both
  crease   ///< with a common crease: its fold angle is +-180 degrees
};

/// Two panels that might meet.
struct PanelPair {
  ContactKind kind;
  int a, b;   ///< panels, a < b
  int joint;  ///< the common vertex, or the crease's index; -1 apart
};

/// Every two panels, each with what they have in common.
std::vector<PanelPair> pairs_of(const Panels& panels);

/// Where a vertex comes among a panel's corners; 4 if it is none of them.
int corner_of(const std::array<int, 4>& corners, int vertex);

}  // namespace misalign::solver
