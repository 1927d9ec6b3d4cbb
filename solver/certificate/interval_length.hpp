// The factor by which an interval of a path should have been longer, by how well it was proven. By
// multiplication alone, so that intervals have the same ends on every machine.
#pragma once

#include <algorithm>

namespace misalign::solver {

/// No interval is made shorter or longer by more at once.
inline constexpr double kMuchShorter = 0.3;

/// The root of this degree, but between kMuchShorter and its inverse.
inline double limited_root(double power, int degree) {
  double low = kMuchShorter, high = 1 / kMuchShorter;
  for (int step = 0; step < 20; ++step) {
    const double middle = 0.5 * (low + high);
    double product = 1;
    for (int k = 0; k < degree; ++k) product *= middle;
    (product <= power ? low : high) = middle;
  }
  return low;
}

/// With the polynomial's error, and the contraction; both grow with a power of the length. What is
/// not known is infinite.
inline double better_length(double error, int error_power, double contraction,
                            int contraction_power) {
  constexpr double kWantedError = 1e-10, kWantedContraction = 0.5;
  if (!(error < 1)) return kMuchShorter;
  const double by_error = limited_root(kWantedError / error, error_power);
  if (!(contraction < 1e3)) return by_error;
  return std::min(by_error, limited_root(kWantedContraction / contraction, contraction_power));
}

}  // namespace misalign::solver
