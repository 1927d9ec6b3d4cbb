// Springs or wires on the diagonals of the holes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// Forces left in the springs of a flat sheet: those on diagonals that lengthen as the sheet folds
/// pull, those on diagonals that shorten push.
struct Preload {
  double each_n = 0;
  struct OfOne {
    int from, to;  ///< the vertices of its diagonal, in any order
    double n;
    bool is_on(const Diagonal& diagonal) const {
      return std::minmax(from, to) == std::minmax(diagonal.from, diagonal.to);
    }
  };
  std::vector<OfOne> others = {};  ///< springs with another force

  bool is_any() const { return largest_n() > 0; }
  /// The largest force given.
  double largest_n() const {
    double largest_n = each_n;
    for (const OfOne& other : others) largest_n = std::max(largest_n, other.n);
    return largest_n;
  }
  /// Forces of all diagonals' springs. Vertices that are no diagonal have no effect.
  Eigen::VectorXd forces_n(const std::vector<Diagonal>& diagonals) const {
    Eigen::VectorXd forces_n =
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(diagonals.size()), each_n);
    for (const OfOne& other : others) {
      const auto is_its = [&](const Diagonal& diagonal) { return other.is_on(diagonal); };
      const auto at = std::ranges::find_if(diagonals, is_its);
      if (at != diagonals.end()) forces_n(at - diagonals.begin()) = other.n;
    }
    return forces_n;
  }
};

/// One spring on every diagonal, relaxed on the flat sheet except for its preload.
struct Actuators {
  double stiffness_n_per_mm = 50;      ///< the paper's springs
  std::optional<double> stroke_limit;  ///< largest |L - L0| / L0; 0.08 for the paper's Ti-Ni wires
  Preload preload = {};
};

}  // namespace misalign::solver
