// Fits springs of a table to lengths of a diagonal, each with a link of wire or a spacer.
#pragma once

#include <algorithm>
#include <optional>

namespace misalign::solver {

enum class SpringAction {
  pulls,  ///< an extension spring, in line with a link of wire
  pushes  ///< a compression spring, on a rod or in a tube, in line with a spacer
};

/// A type of springs. Lengths are those between its hooks, or between its flat ends.
struct StockSpring {
  SpringAction action = SpringAction::pulls;
  double rate_n_per_mm, free_mm;
  double limit_mm;  ///< longest length in use of a spring that pulls, shortest of one that pushes
  double wire_mm, outer_mm;  ///< diameters
  double price;
  /// Initial tension: a spring that pulls lengthens by larger forces alone.
  double initial_n = 0;

  /// Force at a length at which the spring is longer than free if it pulls, shorter if it pushes;
  /// positive where it pulls.
  double force_n(double length_mm) const {
    return initial_n + rate_n_per_mm * (length_mm - free_mm);
  }
  /// Length of a linear spring with the same forces and no initial tension.
  double linear_free_mm() const { return free_mm - initial_n / rate_n_per_mm; }
};

/// Limits of links and of forces.
struct LinkLimits {
  double step_mm = 1;   ///< links have multiples of this length
  double least_mm = 5;  ///< two eyes of wire, or a spacer
  std::optional<double> largest_force_n;
};

/// Lengths of links in steps; none where `most` is less than `least`.
struct LinkRange {
  int least, most;

  bool is_empty() const { return most < least; }
  bool contains(int steps) const { return least <= steps && steps <= most; }
};

/// Returns the links with which a spring is tense, or compressed, at every length between two, is
/// not used beyond its limit, and has no larger force than permitted.
LinkRange links_of(const StockSpring& spring, double least_mm, double most_mm,
                   const LinkLimits& limits);

}  // namespace misalign::solver
