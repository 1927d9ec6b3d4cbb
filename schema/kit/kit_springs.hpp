// Compares the springs of a kit with the diagonals of the verdict as the sheet folds: a bore inside
// a panel turns with it, so that its spring may differ.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "schema/kit/kit_bores.hpp"

namespace misalign::schema {

/// Change of a length from flat to folded.
enum class LengthTrend { constant, lengthens, shortens, reverses };

/// "lengthens".
const char* word_of(LengthTrend trend);

struct KitSpring {
  SpringEnd from, to;
  /// Lengths when flat, and at each row of the path that is used (kit_rows).
  std::vector<double> length_mm, diagonal_mm;
  LengthTrend trend, diagonal_trend;

  /// The longest less the shortest length.
  double stroke_mm() const;
  /// Returns whether the trends differ; the verdict promises nothing of a diagonal that reverses.
  bool contradicts_verdict() const {
    return diagonal_trend != LengthTrend::reverses && trend != diagonal_trend;
  }
};

/// Number of the path's rows that a kit is used in: up to the angle of use (none: D), or of a sheet
/// that deploys from nothing those that are shown.
Eigen::Index kit_rows(const solver::Sheet& sheet, const std::optional<double>& from_deg);

/// The springs in the order of diagonals, over the path's first `rows` rows; none without
/// --spring-bore.
std::vector<KitSpring> kit_springs(const solver::Sheet& sheet, const KitFittings& fittings,
                                   Eigen::Index rows);

/// A sentence on springs that contradict the verdict; empty if none does.
std::string contradiction_of(const std::vector<KitSpring>& springs);

}  // namespace misalign::schema
