// Lists the pairs of panels that might meet, with their common vertex or crease.
#pragma once

#include <array>
#include <vector>

#include "solver/model/panels.hpp"

namespace misalign::solver {

enum class ContactKind {
  apart,   ///< panels without a common vertex: their distance is 0
  vertex,  ///< panels with one common vertex: a ray from it lies in both
  crease   ///< panels with a common crease: its fold angle is +-180 degrees
};

/// Two panels that might meet.
struct PanelPair {
  ContactKind kind;
  int a, b;   ///< panels, a < b
  int joint;  ///< the common vertex, or the crease's index; -1 apart
};

/// All pairs of panels, with their common vertex or crease.
std::vector<PanelPair> pairs_of(const Panels& panels);

/// Index of a vertex among a panel's corners; 4 if it is none of them.
int corner_of(const std::array<int, 4>& corners, int vertex);

}  // namespace misalign::solver
