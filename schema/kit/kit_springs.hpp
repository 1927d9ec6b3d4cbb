// The springs of a kit as the sheet folds, beside the diagonals of which the verdict speaks: a bore
// inside a panel turns with it, and its spring may do something else.
#pragma once

#include <string>
#include <vector>

#include "schema/kit/kit_bores.hpp"

namespace misalign::schema {

/// From flat to folded.
enum class LengthTrend { constant, lengthens, shortens, reverses };

/// "lengthens".
const char* word_of(LengthTrend trend);

struct KitSpring {
  SpringEnd from, to;
  /// Flat, and at each row of the path that is shown (Sheet::rows_shown).
  std::vector<double> length_mm, diagonal_mm;
  LengthTrend trend, diagonal_trend;

  /// Longest less shortest.
  double stroke_mm() const;
  /// Of a diagonal that itself reverses the verdict promises nothing.
  bool contradicts_verdict() const {
    return diagonal_trend != LengthTrend::reverses && trend != diagonal_trend;
  }
};

/// In the order of diagonals; none without --spring-bore.
std::vector<KitSpring> kit_springs(const solver::Sheet& sheet, const KitFittings& fittings);

/// How many of them contradict the verdict and how, and what to do; empty if none does.
std::string contradiction_of(const std::vector<KitSpring>& springs);

}  // namespace misalign::schema
